#pragma once

#include "06_importance/inputs.h"
#include "06_importance/steps.h"
#include "grader/judge/compare.h"

#include <cmath>
#include <cstdint>

// Exact moments of contributions, for lab 6.

namespace lab06_tests {

/// The raw moments E[Y], E[Y^2], E[Y^3], E[Y^4] of one value.
struct RawMoments {
  double m1 = 0, m2 = 0, m3 = 0, m4 = 0;

  double variance() const { return m2 - m1 * m1; }
  /// The fourth cumulant.
  double fourth_cumulant() const {
    const double about_mean = m4 - 4 * m3 * m1 + 6 * m2 * m1 * m1 - 3 * std::pow(m1, 4);
    return about_mean - 3 * variance() * variance();
  }
};

inline carlo::grader::Theory theory_of(const RawMoments& m) {
  const double v = m.variance();
  return {m.m1, std::sqrt(v), m.fourth_cumulant() / (v * v)};
}

/// The moments of Y = (k + 1) x^k / ((n + 1) x^n), x with density (n + 1) x^n on [0, 1]. E[Y^m] is
/// finite for (m - 1) n < m k + 1.
inline RawMoments power_moments(double k, double n) {
  const auto moment = [&](int m) {
    return std::pow(k + 1, m) * std::pow(n + 1, 1 - m) / (m * k - (m - 1) * n + 1);
  };
  return {moment(1), moment(2), moment(3), moment(4)};
}

/// The moments of Y = edge (k + 1) x^k, x uniform on [0, edge).
inline RawMoments uncovered_moments(double k, double edge) {
  const auto moment = [&](int m) {
    return std::pow(edge * (k + 1), m) * std::pow(edge, m * k) / (m * k + 1);
  };
  return {moment(1), moment(2), moment(3), moment(4)};
}

/// The moments of one dart's contribution: 0, or (b - a) g_max f / g with density g / ((b - a)
/// g_max). The integrals of f^m / g^(m-1) by Simpson's rule on 20 000 cells: exact to 1e-12.
inline RawMoments dart_moments(Profile profile) {
  const Dartboard board = dartboard(profile);
  const double scale = (board.b - board.a) * board.g_max;
  const auto moment = [&](int m) {
    const auto integrand = [&](double x) {
      const double g = profile_g(profile, x);
      return g > 0 ? std::pow(profile_f(profile, x), m) / std::pow(g, m - 1) : 0;
    };
    // The step's lower half is 0: the rule covers only the smooth part.
    const double first = profile == Profile::step ? 0.5 : board.a;
    constexpr int n = 20'000;
    const double h = (board.b - first) / n;
    double sum = integrand(first) + integrand(board.b);
    for (int i = 1; i < 2 * n; ++i)
      sum += (i % 2 == 1 ? 4 : 2) * integrand(first + i * h / 2);
    return std::pow(scale, m - 1) * sum * h / 6;
  };
  return {moment(1), moment(2), moment(3), moment(4)};
}

/// The contribution of one sample of `own` in a cell, as part of its technique's mean.
inline double step_contribution(Weighting kind, const StepDensity& own, double n_own,
                                const StepDensity& other, double n_other, std::size_t cell) {
  const double p = own.pdf_in(cell);
  if (!(p > 0)) return 0;
  return plain_weight(kind, n_own, p, n_other, other.pdf_in(cell)) * step_f[cell] / p;
}

/// The moments of one weighted sample of `own`.
inline RawMoments technique_moments(Weighting kind, const StepDensity& own, double n_own,
                                    const StepDensity& other, double n_other) {
  RawMoments m;
  for (std::size_t cell = 0; cell < cells; ++cell) {
    const double y = step_contribution(kind, own, n_own, other, n_other, cell);
    const double p = own.probability(cell);
    m.m1 += p * y;
    m.m2 += p * y * y;
    m.m3 += p * y * y * y;
    m.m4 += p * y * y * y * y;
  }
  return m;
}

/// For the estimate from n_first and n_second samples: cumulants of independent parts add up, and
/// those of a mean of n fall as n^(1 - order).
inline carlo::grader::Theory multi_theory(Weighting kind, const StepDensity& first, double n_first,
                                          const StepDensity& second, double n_second) {
  double mean = 0, variance = 0, fourth = 0;
  const auto add = [&](const RawMoments& m, double n) {
    if (n == 0) return;
    mean += m.m1;
    variance += m.variance() / n;
    fourth += m.fourth_cumulant() / (n * n * n);
  };
  add(technique_moments(kind, first, n_first, second, n_second), n_first);
  add(technique_moments(kind, second, n_second, first, n_first), n_second);
  return {mean, std::sqrt(variance), fourth / (variance * variance)};
}

/// For a single sample, with the first technique chosen with probability `share`.
inline carlo::grader::Theory one_theory(Weighting kind, const StepDensity& first,
                                        const StepDensity& second, double share) {
  RawMoments m;
  const auto add = [&](const StepDensity& own, double chance, const StepDensity& other) {
    for (std::size_t cell = 0; cell < cells; ++cell) {
      const double y = step_contribution(kind, own, chance, other, 1 - chance, cell) / chance;
      const double p = chance * own.probability(cell);
      m.m1 += p * y;
      m.m2 += p * y * y;
      m.m3 += p * y * y * y;
      m.m4 += p * y * y * y * y;
    }
  };
  add(first, share, second);
  add(second, 1 - share, first);
  return theory_of(m);
}

}  // namespace lab06_tests
