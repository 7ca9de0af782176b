#pragma once

#include "grader/judge/compare.h"
#include "grader/judge/figures.h"

#include <fmt/core.h>

#include <string>
#include <vector>

namespace lab03_tests {

/// Chi-square test of counts against the expected ones (>= 100 each), at the level of one
/// comparison; too good a fit fails as well.
inline carlo::grader::Verdict chi_square_is(const std::string& what,
                                            const std::vector<double>& counts,
                                            const std::vector<double>& expected) {
  double statistic = 0;
  for (std::size_t i = 0; i < counts.size(); ++i)
    statistic += (counts[i] - expected[i]) * (counts[i] - expected[i]) / expected[i];
  const auto freedom = static_cast<double>(counts.size() - 1);
  double count = 0;
  for (const double number : expected)
    count += number;
  carlo::grader::Verdict verdict = carlo::grader::chi_square_fits(what, statistic, freedom);
  verdict.effect = carlo::grader::effect_on_cells(statistic, freedom, count);
  if (!verdict.passed) verdict.figure = carlo::grader::counts_figure({}, counts, expected);
  return verdict;
}

}  // namespace lab03_tests
