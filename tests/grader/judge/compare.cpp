#include "grader/judge/compare.h"

#include "grader/judge/figures.h"
#include "grader/judge/numbers.h"
#include "stats/distributions.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace carlo::grader {
namespace {

double sum(std::span<const double> values, const std::function<double(double)>& f) {
  long double total = 0;
  for (const double value : values)
    total += f(value);
  return static_cast<double>(total);
}

double mean_of(std::span<const double> values) {
  return sum(values, [](double x) { return x; }) / static_cast<double>(values.size());
}

double mean_square_about(std::span<const double> values, double centre) {
  return sum(values, [centre](double x) { return (x - centre) * (x - centre); }) /
         static_cast<double>(values.size());
}

/// Returns whether a value comes from an uninitialised variable or array. Judged code finds a
/// pattern there (carlo_lab.cmake, worker/heap_guard.cpp): as a double it is -5.3e303, and sums,
/// means and small multiples are close to that; counts begin at a whole number of it.
bool is_without_start(double value) {
  const auto is_near = [value](double start, double within) {
    return std::abs(value - start) <= within;
  };
  constexpr double int_by_gcc = -16843010, int_by_clang = -1431655766;
  constexpr double long_by_gcc = -72340172838076674., long_by_clang = -6148914691236517206.;
  const bool count = is_near(int_by_gcc, 1e6) || is_near(int_by_clang, 1e6) ||
                     is_near(long_by_gcc, 1e9) || is_near(long_by_clang, 1e9);
  return count || (std::abs(value) > 1e296 && std::abs(value) < 1e306);
}

void name_suspects(Verdict& verdict, const Suspects& suspects,
                   const std::function<double(double)>& slack, double measured) {
  if (verdict.passed) return;
  if (is_without_start(measured)) {
    verdict.diagnoses = {{"no-start-value",
                          "a variable is read that was never given a value: start each sum and "
                          "each count with `= 0`."}};
    return;
  }
  for (const Suspect& suspect : suspects) {
    verdict.looked_for.push_back(suspect.diagnosis);
    if (std::abs(measured - suspect.value) <= slack(suspect.value)) {
      verdict.diagnoses.push_back(suspect.diagnosis);
    }
  }
}

/// The largest distance from a suspect's value, in standard deviations, at which a value is
/// attributed to it.
constexpr double fit = 6;

}  // namespace

double comparison_alpha() {
  return sidak(lab_alpha, lab_budget);
}

void conclude(Verdict& verdict, const std::string& statistic, double p) {
  verdict.p = p;
  verdict.passed = p >= comparison_alpha();
  if (std::isnan(p)) {
    verdict.certainty = statistic + " is no number";
  } else if (p < 1e-15) {
    verdict.certainty = statistic + ": this cannot be chance";
  } else {
    verdict.certainty = fmt::format(
        "{}, p = {:.2g}: a right solution is this far off by chance once in {:.2g} runs", statistic,
        p, 1 / p);
  }
}

Verdict mean_is(const std::string& what, std::span<const double> values, const Theory& theory,
                const Suspects& suspects) {
  const double root = std::sqrt(static_cast<double>(values.size()));
  const double mean = mean_of(values);
  const double z = (mean - theory.mean) / (theory.sd / root);
  const double spread = std::sqrt(mean_square_about(values, mean));
  Verdict verdict;
  verdict.what = what;
  verdict.measured = fmt::format("{:.6g} ± {:.2g}, the mean of {}", mean, theory.sd / root,
                                 counted(static_cast<double>(values.size()), "value"));
  verdict.expected = fmt::format("{:.6g}", theory.mean);
  const std::string z_text =
      std::abs(z) < 1e6 ? fmt::format("{:.1f}", z) : fmt::format("{:.1e}", z);
  conclude(verdict, "z = " + z_text, normal_two_sided(z));
  verdict.effect = effect_on_mean(mean - theory.mean, theory.sd, static_cast<double>(values.size()),
                                  spread * spread);
  // A mistake has its own spread, which the values show.
  const double slack = fit * spread / root;
  name_suspects(
      verdict, suspects, [slack](double) { return slack; }, mean);
  if (!verdict.passed && !values.empty()) {
    verdict.figure = mean_figure(values, theory.mean, theory.sd);
  }
  return verdict;
}

Verdict variance_is(const std::string& what, std::span<const double> values, const Theory& theory,
                    const Suspects& suspects) {
  const double variance = mean_square_about(values, theory.mean);
  const double expected = theory.sd * theory.sd;
  const double dof = 2 * static_cast<double>(values.size()) / (2 + theory.excess_kurtosis);
  const double ratio = variance / expected;
  Verdict verdict;
  verdict.what = what;
  verdict.measured = fmt::format("{:.5g}, from {}", variance,
                                 counted(static_cast<double>(values.size()), "value"));
  verdict.expected = fmt::format("{:.5g}", expected);
  conclude(verdict, fmt::format("ratio {:.4g}", ratio), chi_square_two_sided(ratio * dof, dof));
  verdict.effect = effect_on_variance(ratio, dof);
  const double slack = fit * std::sqrt(2 / dof);
  name_suspects(
      verdict, suspects, [slack](double value) { return slack * value; }, variance);
  if (!verdict.passed && !values.empty()) {
    verdict.figure = spread_figure(values, theory.mean, theory.sd);
  }
  return verdict;
}

Verdict uniform_on(const std::string& what, std::vector<double> values, double lower,
                   double upper) {
  Verdict verdict;
  verdict.what = what;
  verdict.expected = fmt::format("uniform on [{}, {})", lower, upper);
  const bool finite =
      std::all_of(values.begin(), values.end(), [](double x) { return std::isfinite(x); });
  if (!finite || values.empty()) {
    verdict.measured = values.empty() ? "no values" : "values that are no numbers";
    return verdict;
  }
  std::sort(values.begin(), values.end());
  const auto n = static_cast<double>(values.size());
  double distance = 0;
  double rank = 0;
  for (const double value : values) {
    const double cdf = std::clamp((value - lower) / (upper - lower), 0.0, 1.0);
    distance = std::max({distance, cdf - rank / n, (rank + 1) / n - cdf});
    rank += 1;
  }
  verdict.measured =
      fmt::format("{} from {:.6g} to {:.6g}", counted(n, "value"), values.front(), values.back());
  conclude(verdict, fmt::format("largest distance of the distributions {:.3g}", distance),
           kolmogorov_smirnov(distance, values.size()));
  verdict.effect = effect_on_distribution(distance, n);
  if (!verdict.passed) verdict.figure = uniform_figure(values, lower, upper);
  return verdict;
}

Verdict equals(const std::string& what, double measured, double expected, double tolerance,
               const Suspects& suspects) {
  Verdict verdict;
  verdict.what = what;
  verdict.passed = std::abs(measured - expected) <= tolerance;
  const bool close = std::abs(measured - expected) <= 1e-4 * std::abs(expected);
  // Only as many digits as show a difference.
  verdict.measured = number_in_report(measured, close ? 16 : 6);
  verdict.expected = number_in_report(expected, close ? 16 : 6);
  if (tolerance > 0) verdict.expected += fmt::format(" within {:.1g}", tolerance);
  const auto slack = [tolerance](double value) {
    return std::max(tolerance, 1e-9 * std::abs(value));
  };
  name_suspects(verdict, suspects, slack, measured);
  return verdict;
}

Verdict all_equal(const std::string& what, std::span<const double> measured,
                  std::span<const double> expected, double tolerance,
                  const std::vector<Diagnosis>& diagnosis) {
  if (measured.size() != expected.size()) {
    return holds(what, false, fmt::format("{} values", measured.size()),
                 fmt::format("{} values", expected.size()), diagnosis);
  }
  for (std::size_t i = 0; i < measured.size(); ++i) {
    Verdict verdict = equals(what, measured[i], expected[i], tolerance);
    if (verdict.passed) continue;
    verdict.what += fmt::format(" (number {})", i + 1);
    verdict.diagnoses = diagnosis;
    if (measured.size() == 1) return verdict;
    verdict.figure = differences_listing(
        "number", [](std::size_t k) { return fmt::format("{}", k + 1); }, measured, expected,
        [&](std::size_t k) { return !(std::abs(measured[k] - expected[k]) <= tolerance); });
    return verdict;
  }
  return holds(what, true, fmt::format("all {} equal", measured.size()), "all equal");
}

Verdict holds(const std::string& what, bool passed, const std::string& measured,
              const std::string& expected, const std::vector<Diagnosis>& diagnosis) {
  Verdict verdict;
  verdict.passed = passed;
  verdict.what = what;
  verdict.measured = measured;
  verdict.expected = expected;
  if (!passed) verdict.diagnoses = diagnosis;
  return verdict;
}

Verdict is_so(const std::string& what, bool passed, const std::string& otherwise,
              const std::string& expected, const std::vector<Diagnosis>& diagnosis) {
  return holds(what, passed, passed ? expected : otherwise, expected, diagnosis);
}

Verdict chi_square_fits(const std::string& what, double statistic, double freedom,
                        const std::string& of) {
  Verdict verdict;
  verdict.what = what;
  verdict.measured = fmt::format("chi-square {:.5g}{}", statistic, of);
  verdict.expected = fmt::format("{:g} ± {:.3g}", freedom, std::sqrt(2 * freedom));
  conclude(verdict, fmt::format("{:.3g} times what is expected", statistic / freedom),
           chi_square_two_sided(statistic, freedom));
  return verdict;
}

}  // namespace carlo::grader
