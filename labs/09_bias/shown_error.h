#pragma once

#include "bias.h"
#include "course/report/table.h"

#include <algorithm>
#include <cmath>

namespace lab09 {

/// The size of an error with both parts.
inline double total_error(const ErrorParts& parts) {
  return std::sqrt(std::max(parts.bias2 + parts.variance, 0.0));
}

/// The root of a mean square, with the square's sign: an estimate of bias^2 is right on average,
/// and so comes out below 0 where the bias is lost in noise. Such a bias is shown with a minus, not
/// as 0.
inline double signed_root(double square) {
  return std::copysign(std::sqrt(std::abs(square)), square);
}

/// The same in a table, in per cent.
inline carlo::Cell percent_of_root(double square, int digits) {
  return carlo::percent_cell(signed_root(square), digits);
}

/// A table's note on such a bias.
constexpr const char* minus_is_noise = "a bias with a minus is one that noise hides";

}  // namespace lab09
