#pragma once

#include "grader/protocol/frame.h"
#include "support/error.h"

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace lab05_tests {

/// The rows that `work` returns; rows of NaN if it is refused, so that the check can continue.
template <class Work>
carlo::grader::Rows rows_or_nan(std::size_t rows, std::size_t columns, const Work& work) {
  try {
    return work();
  } catch (const carlo::Error&) {
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    return {columns, std::vector<double>(rows * columns, nan)};
  }
}

constexpr int bad_weight_kinds = 5;
inline const char* bad_weights_name(int kind) {
  constexpr const char* names[] = {"no weights", "a negative weight", "a weight that is NaN",
                                   "all weights 0", "an infinite weight"};
  return names[kind];
}

inline std::vector<double> bad_weights(std::int64_t kind) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  switch (kind) {
    case 0:
      return {};
    case 1:
      return {1, -0.5, 1};
    case 2:
      return {1, nan, 1};
    case 3:
      return {0, 0, 0};
    default:
      return {1, infinity};
  }
}

/// Their sum is above the largest double.
inline std::vector<double> huge_weights() {
  return {1.5e308, 0.5e308, 1e308};
}

constexpr int bad_cell_kinds = 5;
inline const char* bad_cells_name(int kind) {
  constexpr const char* names[] = {"three weights for 2 x 2 cells", "all weights 0",
                                   "a negative weight in a row of sum 0", "a weight that is NaN",
                                   "five weights for 2 x 2 cells"};
  return names[kind];
}

inline std::vector<double> bad_cells(std::int64_t kind) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  switch (kind) {
    case 0:
      return {1, 1, 1};
    case 1:
      return {0, 0, 0, 0};
    case 2:
      return {1, -1, 1, 1};
    case 3:
      return {1, 1, nan, 1};
    default:
      return {1, 1, 1, 1, 1};
  }
}

}  // namespace lab05_tests
