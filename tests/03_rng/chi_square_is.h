#pragma once

#include "grader/judge/compare.h"
#include "stats/distributions.h"

#include <fmt/core.h>

#include <string>
#include <vector>

namespace lab03_tests {

/// Chi-square test of counts against what is expected of each (>= 100), at the level of one
/// comparison; too good a fit fails as well.
inline carlo::grader::Verdict chi_square_is(const std::string& what,
                                            const std::vector<double>& counts,
                                            const std::vector<double>& expected) {
  double statistic = 0;
  for (std::size_t i = 0; i < counts.size(); ++i)
    statistic += (counts[i] - expected[i]) * (counts[i] - expected[i]) / expected[i];
  const auto freedom = static_cast<double>(counts.size() - 1);
  carlo::grader::Verdict verdict;
  verdict.what = what;
  verdict.p = carlo::chi_square_two_sided(statistic, freedom);
  double count = 0;
  for (const double number : expected)
    count += number;
  verdict.effect = carlo::grader::effect_on_cells(statistic, freedom, count);
  verdict.passed = *verdict.p >= carlo::grader::comparison_alpha();
  verdict.measured = fmt::format("chi-square {:.4g}", statistic);
  verdict.expected = fmt::format("{} or so", freedom);
  verdict.certainty = fmt::format("p = {:.2g}", *verdict.p);
  return verdict;
}

}  // namespace lab03_tests
