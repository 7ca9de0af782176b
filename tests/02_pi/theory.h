#pragma once

// The theoretical values of lab 2's numbers, derived here and not taken from any solution.

#include "grader/judge/compare.h"

#include <cmath>
#include <numbers>

namespace lab02_tests {

constexpr double pi = std::numbers::pi;
constexpr double quarter_disc = pi / 4;

/// For the number of hits among n darts: binomial.
inline carlo::grader::Theory hits_theory(double n, double p = quarter_disc) {
  const double variance = n * p * (1 - p);
  return {n * p, std::sqrt(variance), (1 - 6 * p * (1 - p)) / variance};
}

/// The raw moments E[Y^2], E[Y^3], E[Y^4] of an integrand on [0, 1) whose mean is π.
struct RawMoments {
  double m2, m3, m4;
};

/// For 4 sqrt(1 - x^2): the integrals of (1 - x^2)^(k/2).
constexpr RawMoments circle_moments{32.0 / 3, 12 * pi, 256 * 8.0 / 15};
/// For 4 / (1 + x^2): with x = tan t, the integrals of cos^(2k-2) t over [0, π/4].
constexpr RawMoments arctangent_moments{2 * pi + 4, 6 * pi + 16, 20 * pi + 60 - 4.0 / 3};

/// For the mean of n values: the excess kurtosis falls as 1 / n.
inline carlo::grader::Theory theory_of_mean(const RawMoments& m, double n) {
  const double variance = m.m2 - pi * pi;
  const double fourth = m.m4 - 4 * m.m3 * pi + 6 * m.m2 * pi * pi - 3 * std::pow(pi, 4);
  return {pi, std::sqrt(variance / n), (fourth / (variance * variance) - 3) / n};
}

struct ScoreLimits {
  double lower, upper;
};

/// The two p that lie z of their own standard deviations from the rate s of n trials: the roots of
/// (1 + t) p^2 - (2 s + t) p + s^2 = 0, t = z^2 / n, in the form without cancellation.
inline ScoreLimits score_limits(double n, double hits, double z) {
  const double s = hits / n;
  const double t = z * z / n;
  const double q = ((2 * s + t) + std::sqrt(t * t + 4 * s * (1 - s) * t)) / 2;
  return {s * s / q, q / (1 + t)};
}

/// The exact probability that an interval covers p: the sum of the binomial probabilities of the
/// hits whose interval does, according to `covers(hits)`.
template <class Covers>
double coverage(int n, double p, const Covers& covers) {
  double sum = 0;
  for (int k = 0; k <= n; ++k) {
    const double log_probability = std::lgamma(n + 1.0) - std::lgamma(k + 1.0) -
                                   std::lgamma(n - k + 1.0) + k * std::log(p) +
                                   (n - k) * std::log1p(-p);
    if (covers(k)) sum += std::exp(log_probability);
  }
  return sum;
}

}  // namespace lab02_tests
