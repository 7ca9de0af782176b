// Checks of exercises 2.3 and 2.4.

#include "02_pi/drawn.h"
#include "02_pi/reference.h"
#include "02_pi/theory.h"
#include "grader/judge/judge.h"
#include "grader/protocol/next_words.h"

#include <algorithm>
#include <array>
#include <cmath>

using namespace carlo::grader;
using namespace lab02_tests;

namespace {

const Unsaid unsaid{"integrand"};

const Diagnosis factor_missing{"factor-four-missing",
                               "the integrand lacks its factor 4: its integral is π/4."};
const Diagnosis squares_of_sum{"squares-is-not-the-sum-of-squares",
                               "squares has to be the sum of the y^2, not the square of the sum."};
const Diagnosis float_sum{"float-accumulation",
                          "a sum is kept in a float somewhere: 7 digits are not enough."};
const Diagnosis by_n{"variance-divided-by-n",
                     "the variance is divided by N; the unbiased estimate takes N - 1."};
const Diagnosis error_of_one{"standard-error-of-one-number",
                             "the standard deviation of one number is given; that of the mean is "
                             "smaller by sqrt(N)."};
const Diagnosis variance_given{"variance-not-its-root",
                               "the variance is given: its square root is asked for."};
const Diagnosis of_share{"deviation-of-the-share",
                         "this is the result for a score of 1 or 0, not of 4 or 0."};
const Diagnosis mean_not_subtracted{"mean-square-only",
                                    "the root of the mean square is given; the square of the "
                                    "mean has to be subtracted first."};
const Diagnosis not_squared{"samples-not-squared",
                            "the error falls with the root of N: half the error takes four times "
                            "the samples, not twice."};
const Diagnosis rounded_down{"samples-rounded-down",
                             "the number is rounded down (or to nearest), so the interval is "
                             "slightly wider than required."};
const Diagnosis one_more{"samples-one-more",
                         "where the number of samples is whole already, one too many is taken: "
                         "round up only what is not whole."};
const Diagnosis z_missing{"z-missing",
                          "the half width is treated as one standard error, not as "
                          "z of them."};
const Diagnosis one_not_squared{
    "one-factor-not-squared",
    "one of z, deviation and half_width is not squared: N is the square "
    "of z deviation / half_width, of all of it."};
const Diagnosis full_width{"full-width-for-half",
                           "half_width is taken for the whole width of the interval."};

const Diagnosis root_of_negative{"root-of-a-number-below-zero",
                                 "for equal numbers rounding leaves a spread slightly below 0, "
                                 "whose root is NaN: treat it as 0."};
const Diagnosis samples_cut{"samples-in-32-bits",
                            "more samples than a 32-bit integer can count (2^31 - 1) are needed, "
                            "and the number is truncated: use 64 bits."};

struct Method {
  const char* function;
  const char* name;
  Integrand integrand;
  RawMoments moments;
};
constexpr std::array<Method, 2> methods{
    {{"sum_circle", "4 sqrt(1 - x^2)", Integrand::circle, circle_moments},
     {"sum_arctangent", "4 / (1 + x^2)", Integrand::arctangent, arctangent_moments}}};

/// Converts to the probes' parameter.
double number_of(Integrand which) {
  return which == Integrand::circle ? 0 : 1;
}

/// A sum of n values is right to 1e-12 in double, but not to 1e-8 in float.
Verdict sum_equals(const std::string& what, double measured, double expected,
                   const Suspects& suspects) {
  Verdict verdict = equals(what, measured, expected, 1e-10 * expected, suspects);
  const bool near = std::abs(measured - expected) <= 1e-3 * expected;
  if (!verdict.passed && near) verdict.diagnoses.push_back(float_sum);
  return verdict;
}

void judge_mean(const std::string& list, std::array<double, 3> sums, double mean, double variance) {
  const auto [count, sum, squares] = sums;
  const Rows rows =
      probe("Lab 2.3 mean", {.numbers = {{"count", count}, {"sum", sum}, {"squares", squares}}},
            {.columns = 2, .finite = false});
  const double error = std::sqrt(variance / count);
  Suspects suspects;
  if (error > 0) {
    suspects = {{error * std::sqrt((count - 1) / count), by_n},
                {std::sqrt(variance), error_of_one},
                {variance / count, variance_given}};
  }
  judge(equals("the mean of " + list, rows.at(0, 0), mean, 1e-12 * mean));
  // The spread of equal numbers is rounding only: a few 1e-16, with a root of 1e-8.
  Verdict verdict = equals("the standard error of " + list, rows.at(0, 1), error,
                           error > 0 ? 1e-12 * error : 1e-7, suspects);
  if (std::isnan(rows.at(0, 1)) && count > 1 && variance == 0) {
    verdict.diagnoses.push_back(root_of_negative);
  }
  judge(verdict);
}

void judge_deviation(const std::string& what, double measured, double mean_square, bool darts) {
  const double variance = mean_square - pi * pi;
  const double root = std::sqrt(variance);
  Suspects suspects{{variance, variance_given}, {std::sqrt(mean_square), mean_not_subtracted}};
  if (darts) suspects.push_back({root / 4, of_share});
  judge(equals(what, measured, root, 1e-9, suspects));
}

void judge_samples(const PlanQuestion& plan, double measured, double tolerance) {
  const double root = plan.z * plan.deviation / plan.half_width;
  const double expected = std::max(1.0, std::ceil(root * root));
  const double without_z = root / plan.z;
  Suspects suspects;
  if (expected > 2)
    suspects = {{std::ceil(root), not_squared},
                {std::floor(root * root), rounded_down},
                {std::round(root * root), rounded_down},
                {std::ceil(4 * root * root), full_width},
                {std::ceil(without_z * without_z), z_missing},
                {std::ceil(root * root / plan.z), one_not_squared},
                {std::ceil(root * root / plan.deviation), one_not_squared},
                {std::ceil(root * root * plan.half_width), one_not_squared}};
  if (tolerance == 0 && root > 0 && root * root == expected)
    suspects.push_back({expected + 1, one_more});
  constexpr double most = 2147483647;
  if (expected > most) {
    for (const double cut : {1.0, most, -most - 1, 0.0, std::fmod(expected, 2 * (most + 1))})
      suspects.push_back({cut, samples_cut});
  }
  judge(equals(fmt::format("the samples for a half width of {:g}, deviation {:.4g}, "
                           "z = {:g}",
                           plan.half_width, plan.deviation, plan.z),
               measured, expected, tolerance, suspects));
}

void judge_plan(const PlanQuestion& plan, double tolerance) {
  const Rows rows = probe(
      "Lab 2.4 samples",
      {.numbers = {{"deviation", plan.deviation}, {"half_width", plan.half_width}, {"z", plan.z}}},
      {});
  judge_samples(plan, rows.at(0, 0), tolerance);
}

}  // namespace

TEST_CASE("Lab 2.3: the sums are those of the integrand at the numbers drawn", "[lab02][ex3]") {
  for (const Method& method : methods) {
    for (const std::int64_t n : {0, 1, 1000, 100'000}) {
      const Answer rows =
          probe("Lab 2.3 record", {.n = n, .numbers = {{"integrand", number_of(method.integrand)}}},
                {.columns = 7, .of = fmt::format("{}, n = {}", method.function, n)});
      const auto count = static_cast<double>(n);
      const carlo::Rng before(rows.seed);
      carlo::Rng rng = before;
      const Totals<long double> totals = totals_of(method.integrand, n, rng);
      const auto sum = static_cast<double>(totals.sum);
      const auto squares = static_cast<double>(totals.squares);
      const NextWords next{rows.at(0, 3), rows.at(0, 4), rows.at(0, 5), rows.at(0, 6)};
      const double drawn = words_drawn(before, next, 8 * n + 64);
      Suspects of_squares{{squares / 16, factor_missing}};
      if (n > 1) of_squares.push_back({rows.at(0, 1) * rows.at(0, 1), squares_of_sum});
      judge(equals(fmt::format("the count, {}", method.name), rows.at(0, 0), count, 0));
      judge(sum_equals(fmt::format("the sum of {} of {}", counted(count, "value"), method.name),
                       rows.at(0, 1), sum, {{sum / 4, factor_missing}}));
      judge(sum_equals(fmt::format("the sum of {} of {}", counted(count, "square"), method.name),
                       rows.at(0, 2), squares, of_squares));
      judge(equals("the numbers drawn (calls of rng.uniform())", drawn / 2, count, 0));
    }
  }
}

// 320 000 values: a shift of .0138 (circle) and .0099 (arctangent) is detected. 20 000 means detect
// a variance that is off by 9 %.
TEST_CASE("Lab 2.3: both estimators are unbiased, with the variance of independent samples",
          "[lab02][ex3]") {
  for (const Method& method : methods) {
    const Rows rows = probe(
        "Lab 2.3 repeated",
        {.n = 16, .numbers = {{"repetitions", 20'000}, {"integrand", number_of(method.integrand)}}},
        {.rows = 20'000});
    const Theory theory = theory_of_mean(method.moments, 16);
    judge(mean_is(fmt::format("the mean of 16 values of {}", method.name), rows.values, theory,
                  {{pi / 4, factor_missing}}));
    judge(variance_is("the variance of these means", rows.values, theory));
  }
}

TEST_CASE("Lab 2.3: the mean of a list and its standard error", "[lab02][ex3]") {
  judge_mean("2 4 4 4 5 5 7 9", {8, 40, 232}, 5, 32.0 / 7);
  judge_mean("2 4", {2, 6, 20}, 3, 2);
  judge_mean("1 2 ... 1000", {1000, 500'500, 333'833'500}, 500.5, 83'416.0 + 2.0 / 3);
}

// The last two lists: one whose sum is exact, and one whose rounding leaves a spread below 0.
TEST_CASE("Lab 2.3: one number, and equal numbers, have standard error 0", "[lab02][ex3]") {
  judge_mean("3 alone", {1, 3, 9}, 3, 0);
  judge_mean("3 3 3 3", {4, 12, 36}, 3, 0);
  double sum = 0, squares = 0;
  for (int i = 0; i < 40; ++i) {
    sum += 0.3;
    squares += 0.3 * 0.3;
  }
  judge_mean("40 times 0.3", {40, sum, squares}, 0.3, 0);
}

TEST_CASE("Lab 2.4: the standard deviations of one sample", "[lab02][ex4]") {
  const Rows rows = probe("Lab 2.4 deviations", {}, {.columns = 3});
  judge_deviation("the deviation of a dart", rows.at(0, 0), 4 * pi, true);
  judge_deviation("the deviation of 4 sqrt(1 - x^2)", rows.at(0, 1), circle_moments.m2, false);
  judge_deviation("the deviation of 4 / (1 + x^2)", rows.at(0, 2), arctangent_moments.m2, false);
}

// Exact where the arithmetic is; otherwise one sample either way is allowed for rounding.
TEST_CASE("Lab 2.4: the smallest number of samples that is enough", "[lab02][ex4]") {
  judge_plan({1, 0.5, 3}, 0);
  judge_plan({3, 0.25, 1}, 0);
  judge_plan({1, 0.375, 1}, 0);
  judge_plan({2.5, 1, 2.25}, 0);
  judge_plan({1.64, 1e-3, 1.96}, 1);
  judge_plan({1.64, 1e-6, 3}, 1);
}

TEST_CASE("Lab 2.4: the samples for drawn deviations and widths", "[lab02][ex4]") {
  constexpr std::int64_t n = 12;
  const Answer rows = probe("Lab 2.4 drawn samples", {.n = n}, {.rows = n});
  const std::vector<PlanQuestion> asked = drawn_plans(rows.seed, n);
  for (std::size_t i = 0; i < rows.count(); ++i)
    judge_samples(asked[i], rows.at(i, 0), 1);
}

TEST_CASE("Lab 2.4: one sample is the least", "[lab02][ex4]") {
  judge_plan({0, 0.1, 2}, 0);
  judge_plan({0.1, 10, 1}, 0);
}
