#pragma once

#include "grader/judge/compare.h"

#include <cmath>

namespace lab01_tests {

/// The raw moments E[Y], E[Y^2], E[Y^3], E[Y^4] of one value.
struct RawMoments {
  double m1 = 0, m2 = 0, m3 = 0, m4 = 0;
};

/// E[x^k] for x uniform on [a, b), a < b.
inline double power_mean(int k, double a, double b) {
  return (std::pow(b, k + 1) - std::pow(a, k + 1)) / ((k + 1) * (b - a));
}

/// The raw moments of x^k for x uniform on [a, b).
inline RawMoments power_moments(int k, double a, double b) {
  return {power_mean(k, a, b), power_mean(2 * k, a, b), power_mean(3 * k, a, b),
          power_mean(4 * k, a, b)};
}

/// Mean, standard deviation and excess kurtosis of `scale` times the mean of n independent values:
/// cumulants of a mean of n fall as n^(1 - order), so the excess kurtosis falls as 1 / n.
inline carlo::grader::Theory theory_of_mean(const RawMoments& m, double n, double scale = 1) {
  const double variance = m.m2 - m.m1 * m.m1;
  const double fourth = m.m4 - 4 * m.m3 * m.m1 + 6 * m.m2 * m.m1 * m.m1 - 3 * std::pow(m.m1, 4);
  return {scale * m.m1, scale * std::sqrt(variance / n), (fourth / (variance * variance) - 3) / n};
}

}  // namespace lab01_tests
