// Checks of exercise 9.1. Everything has an exact answer: only one bias^2 and one variance are
// unbiased for every distribution and independent of the order (Halmos 1946).

#include "09_bias/error_data.h"
#include "grader/judge/judge.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

using namespace carlo::grader;
using namespace lab09_tests;

namespace {

const Unsaid unsaid_error{"case"};

namespace error_slips {

const Diagnosis mean_noise_in_bias{"noise-of-the-mean-in-the-bias",
                                   "the squared error of the mean is given as bias^2; it also "
                                   "includes the variance of the mean, and is too large on "
                                   "average."};
const Diagnosis one_variance_off{"variance-of-one-taken-off",
                                 "the variance of one estimate is subtracted; that of the mean "
                                 "of n is smaller."};
const Diagnosis bias_cut_off{"bias-cut-off-at-zero",
                             "a bias^2 below 0 is raised to 0, which makes the average of many "
                             "too large."};
const Diagnosis bias_unsquared{"bias-not-squared", "the bias is given, not its square."};
const Diagnosis square_error_as_bias{
    "mean-square-error-as-bias", "the mean of the squared errors is bias^2 and variance together."};
const Diagnosis parts_swapped{"parts-swapped", "bias^2 and variance are exchanged."};
const Diagnosis variance_by_n{"variance-divided-by-n",
                              "the sum of squares is divided by n; the unbiased estimate takes "
                              "n - 1."};
const Diagnosis about_exact{"variance-about-the-exact-value",
                            "distances are taken from the exact value; the variance is that about "
                            "the estimates' own mean."};
const Diagnosis variance_of_mean{"variance-of-the-mean",
                                 "the variance of the mean is given; that of one estimate is n "
                                 "times as large."};
const Diagnosis root_of_variance{"standard-deviation-for-variance",
                                 "the standard deviation is given, not its square."};
const Diagnosis digits_lost{"sum-of-squares-cancellation",
                            "digits are lost far from 0: large numbers of nearly equal size are "
                            "squared and then subtracted."};
const Diagnosis not_logarithmic{"slope-without-logarithms",
                                "a power of n is a straight line only where both axes are "
                                "logarithmic."};
const Diagnosis through_origin{"line-through-the-origin",
                               "the line is forced through the origin; subtracting both means "
                               "allows for its intercept."};
const Diagnosis ends_only{"slope-of-the-ends",
                          "the slope is that between two points; least squares uses all of them."};
const Diagnosis other_way_round{"slope-the-other-way-round",
                                "the slope is that of log n over log error."};
const Diagnosis square_missing{
    "slope-of-correlation",
    "the sum of the products is not divided by the sum of the squares of "
    "log n's distances."};
const Diagnosis other_logarithms{"two-logarithms",
                                 "n and error have logarithms of different bases."};
const Diagnosis own_noise_forgotten{"noise-of-the-biased-method-forgotten",
                                    "the biased method has noise as well, b/t."};
const Diagnosis noises_added{"noises-added",
                             "the two noise terms are added; they belong on "
                             "different sides of the equation."};
const Diagnosis roots_compared{"roots-compared",
                               "standard deviations are subtracted; bias and noise add up as "
                               "squares."};
const Diagnosis bias_squared_twice{"bias-squared-twice", "bias2 is a square already."};
const Diagnosis bias_root{"bias-not-as-square", "bias2 is a square, as a and b are."};
const Diagnosis not_from_start{"ahead-from-the-start-missed",
                               "where a is below b the unbiased method is ahead from the start, "
                               "whatever the bias: the contract wants 0."};
const Diagnosis not_never{"never-missed",
                          "without bias the method with less noise stays ahead: the contract wants "
                          "infinity, also where bias2 has come out below 0."};

}  // namespace error_slips

double list_mean(const std::vector<double>& list) {
  double sum = 0;
  for (const double x : list)
    sum += x / static_cast<double>(list.size());
  return sum;
}

/// The right parts of a list, and the results of mistakes.
struct ErrorTheory {
  double bias2, variance;
  Suspects biases, variances;
};

ErrorTheory error_theory(const Estimates& list) {
  const auto n = static_cast<double>(list.values.size());
  std::vector<double> errors;
  for (const double x : list.values)
    errors.push_back(x - list.exact);
  const double off = list_mean(errors);
  double squares = 0;
  for (const double e : errors)
    squares += (e - off) * (e - off);
  const double variance = squares / (n - 1), bias2 = off * off - variance / n;
  const double square_error = off * off + squares / n;
  ErrorTheory theory{bias2, variance, {}, {}};
  theory.biases = {{off * off, error_slips::mean_noise_in_bias},
                   {off * off - variance, error_slips::one_variance_off},
                   {std::abs(off), error_slips::bias_unsquared},
                   {off, error_slips::bias_unsquared},
                   {square_error, error_slips::square_error_as_bias},
                   {variance, error_slips::parts_swapped},
                   {off * off - squares / n / n, error_slips::variance_by_n}};
  if (bias2 < 0) theory.biases.push_back({0, error_slips::bias_cut_off});
  theory.variances = {{squares / n, error_slips::variance_by_n},
                      {square_error, error_slips::about_exact},
                      {square_error * n / (n - 1), error_slips::about_exact},
                      {variance / n, error_slips::variance_of_mean},
                      {std::sqrt(variance), error_slips::root_of_variance},
                      {bias2, error_slips::parts_swapped}};
  return theory;
}

/// Judges bias^2 and variance; both must be right to `tolerance`, relative to their terms.
bool judge_error_parts(const std::string& name, double bias2, double variance,
                       const ErrorTheory& theory, double tolerance,
                       const std::vector<Diagnosis>& elsewhere_right = {}) {
  const double bias_scale = std::max(std::abs(theory.bias2), theory.variance);
  Verdict bias =
      equals("bias^2 of " + name, bias2, theory.bias2, tolerance * bias_scale, theory.biases);
  Verdict noise = equals("the variance of " + name, variance, theory.variance,
                         tolerance * theory.variance, theory.variances);
  bool passed = true;
  for (Verdict* verdict : {&bias, &noise}) {
    if (!verdict->passed && !elsewhere_right.empty()) verdict->diagnoses = elsewhere_right;
    passed = passed && verdict->passed;
    judge(*verdict);
  }
  return passed;
}

bool judge_drawn_errors(int number, std::int64_t n, const std::string& name, double tolerance,
                        const std::vector<Diagnosis>& elsewhere_right = {}) {
  const std::string of = fmt::format("{} {}", n, name);
  const Answer rows = probe("Lab 9.1 drawn lists", {.n = n, .numbers = {{"case", number}}},
                            {.rows = 2, .columns = 2, .finite = false, .of = of});
  const ErrorTheory theory = error_theory(
      drawn_estimates(estimates_cases().at(static_cast<std::size_t>(number)), rows.seed, n));
  bool right = true;
  for (std::size_t way = 0; way < 2; ++way) {
    right = judge_error_parts(way == 0 ? of : of + ", backwards", rows.at(way, 0), rows.at(way, 1),
                              theory, tolerance, elsewhere_right) &&
            right;
  }
  return right;
}

/// FitSums over the distances from both means.
struct FitSums {
  double xx = 0, xy = 0, yy = 0;
};

FitSums fit_sums(const std::vector<double>& x, const std::vector<double>& y) {
  const double mean_x = list_mean(x), mean_y = list_mean(y);
  FitSums sums;
  for (std::size_t i = 0; i < x.size(); ++i) {
    sums.xx += (x[i] - mean_x) * (x[i] - mean_x);
    sums.xy += (x[i] - mean_x) * (y[i] - mean_y);
    sums.yy += (y[i] - mean_y) * (y[i] - mean_y);
  }
  return sums;
}

std::vector<double> list_logs(std::vector<double> list) {
  for (double& x : list)
    x = std::log(x);
  return list;
}

/// The results of mistakes in the slope of y over x, both logarithms.
Suspects slope_slips(const ErrorCurve& curve) {
  const std::vector<double> x = list_logs(curve.n), y = list_logs(curve.error);
  const FitSums sums = fit_sums(x, y);
  const FitSums plain = fit_sums(curve.n, curve.error), half = fit_sums(curve.n, y),
                other_half = fit_sums(x, curve.error);
  double products = 0, squares = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    products += x[i] * y[i];
    squares += x[i] * x[i];
  }
  const auto [least, most] = std::minmax_element(x.begin(), x.end());
  const double ends = (y[static_cast<std::size_t>(most - x.begin())] -
                       y[static_cast<std::size_t>(least - x.begin())]) /
                      (*most - *least);
  const double slope = sums.xy / sums.xx;
  return {{plain.xy / plain.xx, error_slips::not_logarithmic},
          {half.xy / half.xx, error_slips::not_logarithmic},
          {other_half.xy / other_half.xx, error_slips::not_logarithmic},
          {products / squares, error_slips::through_origin},
          {ends, error_slips::ends_only},
          {(y.back() - y.front()) / (x.back() - x.front()), error_slips::ends_only},
          {sums.xy / sums.yy, error_slips::other_way_round},
          {sums.yy / sums.xy, error_slips::other_way_round},
          {sums.xy / std::sqrt(sums.xx * sums.yy), error_slips::square_missing},
          {slope * std::log(2), error_slips::other_logarithms},
          {slope / std::log(2), error_slips::other_logarithms},
          {slope * std::log(10), error_slips::other_logarithms},
          {slope / std::log(10), error_slips::other_logarithms}};
}

}  // namespace

TEST_CASE("Lab 9.1: bias and variance of short lists", "[lab09][ex1]") {
  const Rows rows = probe("Lab 9.1 short lists", {},
                          {.rows = 2, .columns = 2, .finite = false, .of = "two short lists"});
  judge_error_parts("4 8 for 5", rows.at(0, 0), rows.at(0, 1), error_theory({5, {4, 8}}), 1e-12);
  judge_error_parts("2 6 7 for 3", rows.at(1, 0), rows.at(1, 1), error_theory({3, {2, 6, 7}}),
                    1e-12);
}

TEST_CASE("Lab 9.1: bias and variance of random numbers, near 0 and far from it", "[lab09][ex1]") {
  // Two numbers may be so close that a running mean leaves only eight digits of their difference:
  // in one of 1e7 lists it leaves fewer.
  constexpr double tolerance = 1e-8;
  bool right = true;
  for (const std::int64_t n : {2, 7, 40}) {
    right = judge_drawn_errors(0, n, "numbers of much noise", tolerance) && right;
    right = judge_drawn_errors(1, n, "numbers of much bias", tolerance) && right;
  }
  const std::vector<Diagnosis> lost =
      right ? std::vector{error_slips::digits_lost} : std::vector<Diagnosis>{};
  judge_drawn_errors(2, 40, "numbers around 1e6 that differ by .003", 1e-4, lost);
  judge_drawn_errors(3, 40, "numbers around 1e8 for -1", 1e-6, lost);
}

TEST_CASE("Lab 9.1: the slope of least squares on logarithmic axes", "[lab09][ex1]") {
  for (const std::int64_t n : {2, 5, 10}) {
    const std::string of = fmt::format("{} points", n);
    const Answer rows = probe("Lab 9.1 slope", {.n = n}, {.finite = false, .of = of});
    const ErrorCurve curve = drawn_curve(rows.seed, n);
    const FitSums sums = fit_sums(list_logs(curve.n), list_logs(curve.error));
    // Two points always lie on their line: there some mistakes have no effect.
    judge(equals("the slope through " + of, rows.at(0, 0), sums.xy / sums.xx, 1e-9,
                 n == 2 ? Suspects{} : slope_slips(curve)));
  }
}

TEST_CASE("Lab 9.1: when the unbiased method overtakes", "[lab09][ex1]") {
  const Answer rows =
      probe("Lab 9.1 overtakes", {}, {.rows = 6, .finite = false, .of = "six pairs of methods"});
  const Race race = drawn_race(rows.seed);
  const auto [a, b, bias2] = race;
  const double right = (a - b) / bias2;
  const double roots = std::sqrt(a) - std::sqrt(b);
  judge(equals("seconds until a/t is below bias2 + b/t", rows.at(0, 0), right, 1e-9 * right,
               {{a / bias2, error_slips::own_noise_forgotten},
                {(a + b) / bias2, error_slips::noises_added},
                {roots * roots / bias2, error_slips::roots_compared},
                {roots / bias2, error_slips::roots_compared},
                {right / bias2, error_slips::bias_squared_twice},
                {(a - b) / std::sqrt(bias2), error_slips::bias_root},
                {right * right, error_slips::bias_root}}));
  for (const std::size_t row : {1u, 4u, 5u}) {
    const char* bias = row == 1 ? "" : row == 4 ? ", bias2 = 0" : ", bias2 below 0";
    judge(is_so(fmt::format("seconds where a is below b{}", bias), rows.at(row, 0) == 0,
                number_in_report(rows.at(row, 0)), "0", {error_slips::not_from_start}));
  }
  for (const std::size_t row : {2u, 3u}) {
    judge(is_so(fmt::format("seconds where bias2 is {}", row == 2 ? "0" : "below 0"),
                std::isinf(rows.at(row, 0)) && rows.at(row, 0) > 0,
                number_in_report(rows.at(row, 0)), "infinity", {error_slips::not_never}));
  }
}
