#pragma once

#include <limits>

namespace lab06 {

// The experiments' first example: f = 5 x^4 on [0, 1], and what theory says when it is sampled with
// p = (n + 1) x^n.

inline double power_f(double x) {
  return 5 * x * x * x * x;
}
constexpr double power_integral = 1;

/// The variance of one contribution f/p: E[Y^2] = 25 / ((n + 1)(9 - n)).
inline double power_variance(double n) {
  if (n >= 9) return std::numeric_limits<double>::infinity();
  return 25 / ((n + 1) * (9 - n)) - 1;
}

/// P(Y > y) ~ y^-a with a = (n + 1)/(n - 4); bounded contributions have no tail: infinite.
inline double power_tail_index(double n) {
  return n > 4 ? (n + 1) / (n - 4) : std::numeric_limits<double>::infinity();
}

}  // namespace lab06
