#pragma once

#include "grader/judge/compare.h"
#include "grader/judge/figures.h"

#include <fmt/core.h>

#include <cmath>
#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <vector>

// Comparisons of whole tables of values, for lab 6.

namespace lab06_tests {

/// The results of a typical mistake at every place.
struct Alternative {
  std::vector<double> values;
  carlo::grader::Diagnosis diagnosis;
};

/// Equal within the tolerances; infinities equal themselves, NaN equals NaN.
inline bool agrees(double measured, double expected, double relative, double absolute = 0) {
  if (std::isnan(expected)) return std::isnan(measured);
  if (measured == expected) return true;
  return std::abs(measured - expected) <= relative * std::abs(expected) + absolute;
}

inline bool all_agree(std::span<const double> measured, std::span<const double> expected,
                      double relative, double absolute = 0) {
  if (measured.size() != expected.size()) return false;
  for (std::size_t i = 0; i < measured.size(); ++i) {
    if (!agrees(measured[i], expected[i], relative, absolute)) return false;
  }
  return true;
}

/// Checks that each value equals the expected one within relative |expected| + absolute. Reports
/// the first that does not, described by label(i), and alternatives that all values agree with.
inline carlo::grader::Verdict all_match(const std::string& what,
                                        const std::function<std::string(std::size_t)>& label,
                                        std::span<const double> measured,
                                        std::span<const double> expected, double relative,
                                        double absolute,
                                        const std::vector<Alternative>& alternatives = {}) {
  for (std::size_t i = 0; i < expected.size(); ++i) {
    if (agrees(measured[i], expected[i], relative, absolute)) continue;
    carlo::grader::Verdict verdict = carlo::grader::holds(
        fmt::format("{} {}", what, label(i)), false, fmt::format("{:.17g}", measured[i]),
        fmt::format("{:.17g}", expected[i]));
    verdict.figure = carlo::grader::differences_listing(
        "where", label, measured, expected,
        [&](std::size_t k) { return !agrees(measured[k], expected[k], relative, absolute); });
    for (const Alternative& other : alternatives) {
      if (all_agree(measured, other.values, 1e-9, 1e-12)) {
        verdict.diagnoses.push_back(other.diagnosis);
      }
    }
    return verdict;
  }
  return carlo::grader::holds(what, true, fmt::format("right at all {} places", expected.size()),
                              "right everywhere");
}

}  // namespace lab06_tests
