#pragma once

#include "grader/judge/effect.h"
#include "grader/judge/suspect.h"

#include <span>
#include <string>
#include <vector>

namespace carlo::grader {

// Comparisons turn values into verdicts. NaN anywhere gives a fail.

/// The chance that a lab's statistical comparisons wrongly fail a right solution, all together, and
/// how many of them a lab may hold; each has the level that Sidak's formula gives (1.56e-8,
/// |z| = 5.65).
constexpr double lab_alpha = 1e-6;
constexpr int lab_budget = 64;
double comparison_alpha();

/// Concludes a verdict from the p-value of its statistic ("z = 3.1"): whether it has passed, and in
/// words how sure that is. NaN is a fail.
void conclude(Verdict& verdict, const std::string& statistic, double p);

/// What theory says of one value: its mean, its standard deviation and its excess kurtosis.
struct Theory {
  double mean = 0;
  double sd = 1;
  double excess_kurtosis = 0;
};

/// z test: the mean of independent `values` against theory, with theory's standard deviation and
/// never the one that the values show. The effect caught with power .999 is 8.74 sd / sqrt(count).
Verdict mean_is(const std::string& what, std::span<const double> values, const Theory& theory,
                const Suspects& suspects = {});

/// Chi-square test: the variance of independent `values` about the theoretical mean, two-sided. The
/// degrees of freedom are 2 count / (2 + excess kurtosis), which matches the first two moments of
/// the sum of squares for values that are not normal. Suspects hold variances.
Verdict variance_is(const std::string& what, std::span<const double> values, const Theory& theory,
                    const Suspects& suspects = {});

/// Kolmogorov-Smirnov test: independent `values` are uniform on [lower, upper].
Verdict uniform_on(const std::string& what, std::vector<double> values, double lower, double upper);

/// |measured - expected| <= tolerance.
Verdict equals(const std::string& what, double measured, double expected, double tolerance,
               const Suspects& suspects = {});

/// Each measured value equals the expected one; tells the first that does not, and lists some more.
/// `diagnosis` is what a difference in a value is a sign of.
Verdict all_equal(const std::string& what, std::span<const double> measured,
                  std::span<const double> expected, double tolerance,
                  const std::vector<Diagnosis>& diagnosis = {});

/// A property that holds or not.
Verdict holds(const std::string& what, bool passed, const std::string& measured,
              const std::string& expected, const std::vector<Diagnosis>& diagnosis = {});

/// The same where there is nothing to tell but whether: what holds is measured to be as expected,
/// what does not is `otherwise`.
Verdict is_so(const std::string& what, bool passed, const std::string& otherwise,
              const std::string& expected, const std::vector<Diagnosis>& diagnosis = {});

/// Chi-square test, two-sided: too good a fit fails as well. `of` says what the statistic was made
/// of (" over 64 cells").
Verdict chi_square_fits(const std::string& what, double statistic, double freedom,
                        const std::string& of = {});

}  // namespace carlo::grader
