#pragma once

#include "grader/judge/compare.h"

#include <cmath>

namespace lab04_tests {

/// Cumulants of one random value; those of independent values add.
struct Cumulants {
  double mean = 0, variance = 0, fourth = 0;

  void add(const Cumulants& other, double weight) {
    mean += weight * other.mean;
    variance += weight * weight * other.variance;
    fourth += std::pow(weight, 4) * other.fourth;
  }
  carlo::grader::Theory theory() const {
    return {mean, std::sqrt(variance), variance > 0 ? fourth / (variance * variance) : 0};
  }
};

/// E[x^k] for x uniform on [a, b), a < b.
inline double power_mean(int k, double a, double b) {
  return (std::pow(b, k + 1) - std::pow(a, k + 1)) / ((k + 1) * (b - a));
}

/// From raw moments E[Y], E[Y^2], E[Y^3], E[Y^4].
inline Cumulants from_raw(double m1, double m2, double m3, double m4) {
  const double variance = m2 - m1 * m1;
  const double fourth = m4 - 4 * m3 * m1 + 6 * m2 * m1 * m1 - 3 * std::pow(m1, 4);
  return {m1, variance, fourth - 3 * variance * variance};
}

/// The cumulants of x^k for x uniform on [a, b).
inline Cumulants of_power(int k, double a, double b) {
  return from_raw(power_mean(k, a, b), power_mean(2 * k, a, b), power_mean(3 * k, a, b),
                  power_mean(4 * k, a, b));
}

}  // namespace lab04_tests
