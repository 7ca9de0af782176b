#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

// The test functions of Lab 6.7: constant on each of five cells of [0, 1), so that every moment of
// every estimator is a sum of five terms.

namespace lab06_tests {

constexpr std::size_t cells = 5;
using Steps = std::array<double, cells>;

inline std::size_t cell_of(double x) {
  const auto i = static_cast<std::size_t>(x * static_cast<double>(cells));
  return std::min(i, cells - 1);
}

/// A step density: the probability of each cell, in multiples of 1/16.
struct StepDensity {
  Steps sixteenths;

  double pdf_in(std::size_t cell) const {
    return sixteenths[cell] / 16 * static_cast<double>(cells);
  }
  double probability(std::size_t cell) const { return sixteenths[cell] / 16; }
  /// The cell that u chooses. Sixteenths are exact in binary, so no rounding decides.
  std::size_t choose(double u) const {
    double sum = 0;
    for (std::size_t i = 0; i < cells; ++i) {
      sum += sixteenths[i] / 16;
      if (u < sum) return i;
    }
    return cells - 1;
  }
  /// The middle of the cell that u chooses: the estimators only see step functions.
  double sample(double u) const {
    return (static_cast<double>(choose(u)) + 0.5) / static_cast<double>(cells);
  }
};

/// f, and two techniques, neither of which covers it alone; f vanishes where both are 0, and in one
/// cell the first is far too thin.
constexpr Steps step_f = {2, 6, 1, 3, 0};
constexpr StepDensity step_first = {{7, 1, 8, 0, 0}};
constexpr StepDensity step_second = {{0, 6, 2, 8, 0}};
/// A technique that covers f alone.
constexpr StepDensity step_wide = {{3, 5, 2, 4, 2}};

inline double step_integral() {
  double sum = 0;
  for (const double value : step_f)
    sum += value;
  return sum / static_cast<double>(cells);
}

enum class Weighting { balance = 0, power = 1, count = 2 };

/// The textbook formula of the weight: the numbers here are tame.
inline double plain_weight(Weighting kind, double n_own, double p_own, double n_other,
                           double p_other) {
  const int e = kind == Weighting::power ? 2 : 1;
  const double own = std::pow(n_own * p_own, e), other = std::pow(n_other * p_other, e);
  return own > 0 ? own / (own + other) : 0;
}

}  // namespace lab06_tests
