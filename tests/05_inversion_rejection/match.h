#pragma once

#include "grader/judge/compare.h"
#include "grader/judge/figures.h"

#include <fmt/core.h>

#include <cmath>
#include <functional>
#include <span>
#include <string>
#include <vector>

// Comparisons of whole functions and of cell counts, for lab 5.

namespace lab05_tests {

/// A function of u or x: the right one, or that of a typical mistake.
using Formula = std::function<double(double)>;
struct Alternative {
  Formula formula;
  carlo::grader::Diagnosis diagnosis;
};

/// True if the values are those of the formula at every place, including infinities and NaN.
inline bool looks_like(const Formula& formula, std::span<const double> at,
                       std::span<const double> measured) {
  for (std::size_t i = 0; i < at.size(); ++i) {
    const double value = formula(at[i]);
    if (std::isnan(value) && std::isnan(measured[i])) continue;
    if (value == measured[i]) continue;
    if (!(std::abs(value - measured[i]) <= 1e-9 * std::abs(value) + 1e-12)) return false;
  }
  return true;
}

/// Checks that the values at each place equal the formula's within absolute + relative |value|.
/// Reports the first that does not, and an alternative that all values agree with. `axis`: what the
/// places are.
inline carlo::grader::Verdict equals_everywhere(const std::string& what, std::span<const double> at,
                                                std::span<const double> measured,
                                                const Formula& exact, double relative,
                                                double absolute,
                                                const std::vector<Alternative>& alternatives = {},
                                                const std::string& axis = "u") {
  for (std::size_t i = 0; i < at.size(); ++i) {
    const double expected = exact(at[i]);
    const double tolerance = relative * std::abs(expected) + absolute;
    if (std::abs(measured[i] - expected) <= tolerance) continue;
    carlo::grader::Verdict verdict = carlo::grader::equals(
        fmt::format("{} at {} = {}", what, axis, at[i]), measured[i], expected, tolerance);
    for (const Alternative& other : alternatives) {
      if (looks_like(other.formula, at, measured)) verdict.diagnoses.push_back(other.diagnosis);
    }
    std::vector<double> right;
    for (const double x : at)
      right.push_back(exact(x));
    verdict.figure = carlo::grader::curve_figure(axis, at, measured, right, [&](std::size_t k) {
      return !(std::abs(measured[k] - right[k]) <= relative * std::abs(right[k]) + absolute);
    });
    return verdict;
  }
  return carlo::grader::holds(what, true, fmt::format("right at all {} places", at.size()),
                              "right everywhere");
}

/// Chi-square test of `counts` against the exact `masses` of the cells, from `n` samples; too good
/// a fit fails as well. Neighbouring cells are pooled until 100 samples are expected in each, where
/// the nominal tail holds (at 5 it is inflated 6x). A sample outside all cells fails. `axis`: what
/// is divided into cells.
inline carlo::grader::Verdict counts_are(const std::string& what, std::span<const double> counts,
                                         std::span<const double> masses, double n,
                                         const carlo::grader::CellAxis& axis = {}) {
  const auto picture = [&] {
    std::vector<double> right;
    for (const double mass : masses)
      right.push_back(mass * n);
    return carlo::grader::counts_figure(axis, counts, right);
  };
  std::vector<double> found, expected;
  double outside = n, pending_found = 0, pending = 0;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    outside -= counts[i];
    if (masses[i] == 0 && counts[i] > 0) {
      carlo::grader::Verdict verdict =
          carlo::grader::holds(what, false, fmt::format("{} samples in cell {}", counts[i], i + 1),
                               "none: the density is 0 there");
      verdict.figure = picture();
      return verdict;
    }
    pending_found += counts[i];
    pending += masses[i] * n;
    if (pending < 100 && !(i + 1 == counts.size() && expected.empty())) continue;
    found.push_back(pending_found);
    expected.push_back(pending);
    pending_found = pending = 0;
  }
  if (outside != 0) {
    carlo::grader::Verdict verdict = carlo::grader::holds(
        what, false, fmt::format("{} samples outside the support", outside), "none");
    verdict.figure = picture();
    return verdict;
  }
  found.back() += pending_found;
  expected.back() += pending;
  double statistic = 0;
  for (std::size_t i = 0; i < found.size(); ++i)
    statistic += (found[i] - expected[i]) * (found[i] - expected[i]) / expected[i];
  const auto freedom = static_cast<double>(found.size() - 1);
  carlo::grader::Verdict verdict = carlo::grader::chi_square_fits(
      what, statistic, freedom, fmt::format(" from {:g} samples", n));
  verdict.effect = carlo::grader::effect_on_cells(statistic, freedom, n);
  if (!verdict.passed) verdict.figure = picture();
  return verdict;
}

/// The counts of `values` in `cells` equal cells of [first, last], the last one closed; those
/// outside are not counted.
inline std::vector<double> counted(std::span<const double> values, double first, double last,
                                   std::size_t cells) {
  std::vector<double> counts(cells);
  for (const double value : values) {
    if (!(value >= first && value <= last)) continue;
    const auto cell =
        static_cast<std::size_t>((value - first) / (last - first) * static_cast<double>(cells));
    counts[cell < cells ? cell : cells - 1] += 1;
  }
  return counts;
}

/// The mass of each of `cells` equal cells of [first, last] under a CDF.
inline std::vector<double> masses(const Formula& cdf, double first, double last,
                                  std::size_t cells) {
  std::vector<double> result(cells);
  double below = cdf(first);
  for (std::size_t i = 0; i < cells; ++i) {
    const double share = static_cast<double>(i + 1) / static_cast<double>(cells);
    const double above = cdf(first + (last - first) * share);
    result[i] = above - below;
    below = above;
  }
  return result;
}

}  // namespace lab05_tests
