#pragma once

#include "grader/judge/effect.h"
#include "grader/judge/suspect.h"

#include <span>
#include <string>
#include <vector>

namespace carlo::grader {

// Comparisons turn values into verdicts. NaN anywhere is a fail.

/// The probability that a lab's statistical comparisons together wrongly fail a correct solution,
/// and the largest number of them in a lab; each has the level of Sidak's formula (1.25e-8, |z| =
/// 5.69).
constexpr double lab_alpha = 1e-6;
constexpr int lab_budget = 80;
double comparison_alpha();

/// Concludes a verdict from the p-value of its statistic ("z = 3.1"): whether it passed, and in
/// words how certain that is. NaN is a fail.
void conclude(Verdict& verdict, const std::string& statistic, double p);

/// The theory of one value: its mean, its standard deviation and its excess kurtosis.
struct Theory {
  double mean = 0;
  double sd = 1;
  double excess_kurtosis = 0;
};

/// z test: compares the mean of independent `values` with theory, using theory's standard deviation
/// and never that of the values. The effect caught with power .999 is 8.74 sd / sqrt(count).
Verdict mean_is(const std::string& what, std::span<const double> values, const Theory& theory,
                const Suspects& suspects = {});

/// Chi-square test, two-sided: compares the variance of independent `values` about the theoretical
/// mean. The degrees of freedom are 2 count / (2 + excess kurtosis), which matches the first two
/// moments of the sum of squares for values that are not normal. Suspects hold variances.
Verdict variance_is(const std::string& what, std::span<const double> values, const Theory& theory,
                    const Suspects& suspects = {});

/// Kolmogorov-Smirnov test: independent `values` are uniform on [lower, upper].
Verdict uniform_on(const std::string& what, std::vector<double> values, double lower, double upper);

/// Checks |measured - expected| <= tolerance.
Verdict equals(const std::string& what, double measured, double expected, double tolerance,
               const Suspects& suspects = {});

/// Checks that each measured value equals the expected one; reports the first that does not, and
/// lists some more. `diagnosis` is the mistake that a difference indicates.
Verdict all_equal(const std::string& what, std::span<const double> measured,
                  std::span<const double> expected, double tolerance,
                  const std::vector<Diagnosis>& diagnosis = {});

/// Checks a property that holds or not.
Verdict holds(const std::string& what, bool passed, const std::string& measured,
              const std::string& expected, const std::vector<Diagnosis>& diagnosis = {});

/// The same without further detail: if the property holds, the measured text is the expected one,
/// otherwise it is `otherwise`.
Verdict is_so(const std::string& what, bool passed, const std::string& otherwise,
              const std::string& expected, const std::vector<Diagnosis>& diagnosis = {});

/// Chi-square test, two-sided: too good a fit fails as well. `of` says what the statistic was
/// computed from (" over 64 cells").
Verdict chi_square_fits(const std::string& what, double statistic, double freedom,
                        const std::string& of = {});

}  // namespace carlo::grader
