// Checks of exercises 6.1 and 6.2. A mean of n contributions detects a bias of 8.74 sd / sqrt(n)
// with power .999, a variance one of 8.74 sqrt((2 + kurtosis) / n) in relative size (compare.h);
// the sizes are stated at each test.

#include "06_importance/inputs.h"
#include "06_importance/match.h"
#include "06_importance/theory.h"
#include "grader/judge/judge.h"

#include <algorithm>
#include <cmath>

using namespace carlo::grader;
using namespace lab06_tests;

namespace {

/// For all probes of this lab.
const Unsaid unsaid{"kind", "list", "weighting"};

const Diagnosis not_divided{"not-divided-by-the-pdf",
                            "f(x) is not divided by p(x): a point drawn more often has to count "
                            "less."};
const Diagnosis weights_normalised{
    "weights-normalised",
    "the weights 1/p(x) are divided by their own sum or mean: contributions then depend on one "
    "another, and where p does not cover f the integral is wrong. A contribution is f(x)/p(x)."};
const Diagnosis multiplied{"multiplied-by-the-pdf", "f(x) is multiplied by p(x), not divided."};
const Diagnosis zero_by_zero{"division-by-a-pdf-of-zero",
                             "a point where the pdf is 0 has to contribute 0, whatever f is."};
const Diagnosis bad_pdf_accepted{"bad-pdf-accepted",
                                 "a pdf that is negative or NaN is an error, not a contribution."};
const Diagnosis nan_hidden{"nan-of-f-hidden",
                           "an f that is NaN has to stay visible: a hidden NaN is a bias."};
const Diagnosis tiny_pdf{"small-pdf-taken-for-zero",
                         "only a pdf of 0 contributes 0; a small one is a valid pdf."};
const Diagnosis not_sampled{"points-not-drawn-from-p",
                            "the points have to be p.sample(u), not u itself."};
const Diagnosis more_numbers{"more-than-one-number-a-point",
                             "draw one rng.uniform() per contribution: f and p are evaluated at "
                             "the same point."};
const Diagnosis by_n{"variance-divided-by-n",
                     "the mean comes from the same numbers: divide by N - 1."};
const Diagnosis variance_of_mean{"variance-of-the-mean",
                                 "the variance of one contribution is required, not that of the "
                                 "mean."};
const Diagnosis error_of_one{
    "standard-error-without-n",
    "the standard error is that of the mean: the variance over N, then the "
    "root. The lecture's Var(E) is printed without this N."};
const Diagnosis no_root{"standard-error-without-root",
                        "the standard error is the root of the mean's variance."};
const Diagnosis cancelled{"sum-of-squares",
                          "a mean square minus a squared mean loses all digits if the mean is "
                          "large."};
const Diagnosis one_value{"single-value-has-no-spread",
                          "a single value has variance and standard error 0, not 0/0."};
const Diagnosis float_sum{"float-accumulation",
                          "the sum is kept in a float somewhere: 7 digits are not enough."};
const Diagnosis by_deviation{"efficiency-by-standard-deviation",
                             "the efficiency uses the variance, not the standard deviation: 1 / "
                             "(variance x time)."};
const Diagnosis no_time{"efficiency-without-time", "the time of a sample is missing."};

std::vector<double> contributions(double k, double n, std::int64_t count) {
  return probe("Lab 6.1 contributions", {.n = count, .numbers = {{"k", k}, {"n", n}}},
               {.rows = static_cast<std::size_t>(count),
                .of = fmt::format("{:g} x^{:g} with p as x^{:g}", k + 1, k, n)})
      .values;
}

/// The means due to the two mistakes: E[f(x)] and E[f(x) p(x)] under p.
Suspects ratio_suspects(double k, double n) {
  return {{(k + 1) * (n + 1) / (k + n + 1), not_divided},
          {(k + 1) * (n + 1) * (n + 1) / (k + 2 * n + 1), multiplied}};
}

/// With p proportional to f, contributions are all 1; with normalised weights they are all the
/// same, but not 1.
bool are_normalised(const std::vector<double>& of_same_shape) {
  const auto [least, most] = std::minmax_element(of_same_shape.begin(), of_same_shape.end());
  return *most - *least <= 1e-9 * *most && std::abs(*most - 1) > 1e-6;
}

/// Judges contributions. Those with normalised weights look like other mistakes where the weights
/// happen to be equal. f alone is at most 5: contributions that are far larger are spread so widely
/// that their mean fits anything.
void judge_ratio(Verdict verdict) {
  if (!verdict.passed) {
    const std::vector<double> of_same_shape = contributions(4, 4, 1000);
    const bool wide = *std::max_element(of_same_shape.begin(), of_same_shape.end()) > 5.001;
    std::erase_if(verdict.diagnoses,
                  [&](const Diagnosis& d) { return wide && d.id == not_divided.id; });
    if (are_normalised(of_same_shape)) verdict.diagnoses = {weights_normalised};
  }
  judge(verdict);
}

/// x^2 at a point where the pdf is 2 + x.
double contribution_at(double x) {
  return probe("Lab 6.1 at", {.numbers = {{"x", x}}}, {}).at(0, 0);
}

struct Summary {
  double value, variance, error;
};

void judge_summary(const std::string& name, List list, const Summary& right, double tolerance,
                   const std::vector<Diagnosis>& always = {}) {
  const Rows rows = probe("Lab 6.2 summary", {.numbers = {{"list", static_cast<double>(list)}}},
                          {.columns = 3, .finite = false, .of = name});
  const auto n = static_cast<double>(list_of(list).size());
  const auto one = [&](const std::string& what, std::size_t column, double expected,
                       const Suspects& suspects) {
    Verdict verdict =
        equals(fmt::format("{} of {}", what, name), rows.at(0, column), expected,
               tolerance * std::max(std::abs(expected), list == List::far ? 1.0 : 0.0), suspects);
    if (!verdict.passed)
      verdict.diagnoses.insert(verdict.diagnoses.end(), always.begin(), always.end());
    judge(verdict);
  };
  one("the mean", 0, right.value, {});
  Suspects variance, error;
  if (right.variance > 0) {
    const double biased = right.variance * (n - 1) / n;
    variance = {{biased, by_n}, {right.variance / n, variance_of_mean}};
    error = {{std::sqrt(right.variance), error_of_one},
             {std::sqrt(biased), error_of_one},
             {right.variance / n, no_root},
             {std::sqrt(biased / n), by_n},
             {std::sqrt(right.variance) / n, no_root}};
  }
  one("the variance", 1, right.variance, variance);
  one("the standard error", 2, right.error, error);
}

}  // namespace

// 400 000 contributions of f = 5 x^4 with p from x^0 to x^5: sd 1.33, .44, .20, .20, so a bias of
// 1.8 % (uniform) to .3 % is detected with power .999. With p as x^5 contributions have no upper
// bound (tail index 6: mean and variance are finite, the sum's tails normal to far below 1e-8).
TEST_CASE("Lab 6.1: the mean is f's integral, whatever p is", "[lab06][ex1]") {
  for (const double n : {0.0, 2.0, 3.0, 5.0}) {
    const auto values = contributions(4, n, 400'000);
    const Theory theory = theory_of(power_moments(4, n));
    judge_ratio(
        mean_is(fmt::format("5 x^4 with p as x^{:g}", n), values, theory, ratio_suspects(4, n)));
  }
}

// Relative sizes detected with power .999, n = 400 000: 2.5 % (uniform, excess kurtosis 1.3) and
// less.
TEST_CASE("Lab 6.1: the variance falls as theory says while p approaches f",
          "[lab06][ex1][variance]") {
  for (const double n : {0.0, 2.0, 3.0}) {
    const auto values = contributions(4, n, 400'000);
    judge_ratio(variance_is(fmt::format("the variance of 5 x^4 with p as x^{:g}", n), values,
                            theory_of(power_moments(4, n))));
  }
}

TEST_CASE("Lab 6.1: with p proportional to f every single contribution is the integral",
          "[lab06][ex1]") {
  const auto values = contributions(4, 4, 10'000);
  double worst = 0;
  for (const double value : values)
    worst = std::max(worst, std::abs(value - 1));
  judge_ratio(equals("the largest distance of a contribution from 1", worst, 0, 1e-12));
}

// Mean 1/4, sd .144: a bias of .002 is detected with power .999 at n = 400 000.
TEST_CASE("Lab 6.1: a p that does not cover f gives the integral over what it covers",
          "[lab06][ex1]") {
  const char* const what = "2 x with p uniform on [0, 1/2)";
  const auto values =
      probe("Lab 6.1 uncovered", {.n = 400'000, .numbers = {{"k", 1}, {"edge", 0.5}}},
            {.rows = 400'000, .of = what})
          .values;
  judge_ratio(mean_is(what, values, theory_of(uncovered_moments(1, 0.5)), {{0.5, not_divided}}));
}

TEST_CASE("Lab 6.1: f and p are asked at the same point", "[lab06][ex1]") {
  for (const double x : {0.0, 1.0, 3.0}) {
    judge(equals(
        fmt::format("x^2 over 2 + x at {:g}", x), contribution_at(x), x * x / (2 + x), 1e-15,
        x == 0 ? Suspects{} : Suspects{{x * x, not_divided}, {x * x * (2 + x), multiplied}}));
  }
}

TEST_CASE("Lab 6.1: pdfs that are 0, tiny, infinite or no density at all", "[lab06][ex1]") {
  const std::vector<Answers> all = answers();
  const Rows rows =
      probe("Lab 6.1 answers", {}, {.rows = all.size(), .columns = 2, .finite = false});
  for (std::size_t i = 0; i < all.size(); ++i) {
    const std::string what = fmt::format("f = {:g} where the pdf is {:g}", all[i].f, all[i].pdf);
    if (i >= proper_answers) {
      judge(is_so(what, rows.at(i, 1) == 1,
                  rows.at(i, 1) == 0 ? fmt::format("{:g}", rows.at(i, 0)) : "another exception",
                  "a carlo::Error", {bad_pdf_accepted}));
      continue;
    }
    const double right = all[i].pdf > 0 ? all[i].f / all[i].pdf : 0;
    std::vector<Diagnosis> diagnoses;
    if (all[i].pdf == 0) diagnoses = {zero_by_zero};
    if (std::isnan(all[i].f)) diagnoses = {nan_hidden};
    if (all[i].pdf > 0 && all[i].pdf < 1e-100 && rows.at(i, 0) == 0) diagnoses = {tiny_pdf};
    // A product of two tiny numbers is 0 as well.
    const bool product = agrees(rows.at(i, 0), all[i].f * all[i].pdf, 1e-15);
    if (product && std::abs(contribution_at(1) - 3) < 1e-9) diagnoses = {multiplied};
    judge(holds(what, rows.at(i, 1) == 0 && agrees(rows.at(i, 0), right, 1e-15),
                rows.at(i, 1) == 0 ? fmt::format("{:g}", rows.at(i, 0)) : "an exception",
                fmt::format("{:g}", right), diagnoses));
  }
}

TEST_CASE("Lab 6.1: one number a point, in the order drawn", "[lab06][ex1]") {
  constexpr std::size_t n = 50;
  const Rows rows =
      probe("Lab 6.1 record", {.n = n}, {.rows = n + 1, .columns = 3, .finite = false});
  judge(equals("contributions returned", rows.at(n, 0), n, 0));
  judge(equals("calls of p.sample", rows.at(n, 1), n, 0,
               {{0, not_sampled}, {2 * n, more_numbers}, {2 * n - 1, more_numbers}}));
  judge(
      is_so("numbers drawn", rows.at(n, 2) == 1, "not one a point", "one a point", {more_numbers}));
  std::vector<double> expected(column(rows, 1));
  expected.pop_back();
  std::vector<double> given(column(rows, 2)), values(column(rows, 0));
  given.pop_back();
  values.pop_back();
  judge(all_equal("the numbers given to p.sample", given, expected, 0, {not_sampled}));
  // f(x) = x, p = 1/3, x = 3 u.
  std::vector<double> right, raw;
  for (const double u : expected) {
    right.push_back(9 * u);
    raw.push_back(3 * u);
  }
  const auto label = [](std::size_t i) { return fmt::format("number {}", i + 1); };
  judge(all_match("contribution", label, values, right, 1e-13, 0,
                  {{raw, not_divided}, {expected, multiplied}}));
}

TEST_CASE("Lab 6.2: mean, variance and standard error of a list", "[lab06][ex2]") {
  judge_summary("2 4 4 4 5 5 7 9", List::mixed, {5, 32.0 / 7, std::sqrt(32.0 / 56)}, 1e-14);
  judge_summary("ten times 2.5", List::equal, {2.5, 0, 0}, 0);
  judge_summary("zeros", List::zeros, {0, 0, 0}, 0);
}

TEST_CASE("Lab 6.2: a single value tells nothing of its spread", "[lab06][ex2]") {
  judge_summary("one value", List::one, {-3, 0, 0}, 0, {one_value});
}

// 1e8 + 1 and 1e8 - 1: double represents the squares to 2 at best.
TEST_CASE("Lab 6.2: no digits are lost far from zero", "[lab06][ex2]") {
  judge_summary("1000 values 1e8 + 1, 1e8 - 1", List::far,
                {1e8, 1000.0 / 999, std::sqrt(1.0 / 999)}, 1e-7, {cancelled});
}

// A million additions in double lose about 1e-11; in float the sum is off by 1 %.
TEST_CASE("Lab 6.2: a million values are added up in double", "[lab06][ex2]") {
  const Rows rows =
      probe("Lab 6.2 summary", {.numbers = {{"list", static_cast<double>(List::tenths)}}},
            {.columns = 3, .of = "a million times 0.1"});
  judge(holds("the mean of a million times 0.1", std::abs(rows.at(0, 0) - 0.1) <= 1e-11,
              fmt::format("{:.12g}", rows.at(0, 0)), "0.1 within 1e-11", {float_sum}));
}

TEST_CASE("Lab 6.2: efficiency is one over variance times time", "[lab06][ex2]") {
  const auto efficiency = [](double variance, double seconds) {
    return probe("Lab 6.2 efficiency", {.numbers = {{"variance", variance}, {"seconds", seconds}}},
                 {.finite = false})
        .at(0, 0);
  };
  const auto suspects = [](double variance, double seconds) {
    return Suspects{
        {1 / (std::sqrt(variance) * seconds), by_deviation},
        {1 / variance, no_time},
        {variance * seconds,
         {"efficiency-upside-down", "more variance or more time is less efficient, not more."}}};
  };
  judge(equals("of variance 1/4 in 2 s", efficiency(0.25, 2), 2, 1e-15, suspects(0.25, 2)));
  judge(equals("of variance 9 in 10 ns", efficiency(9, 1e-8), 1e8 / 9, 1e-6, suspects(9, 1e-8)));
  judge(holds("of variance 0", efficiency(0, 1e-8) == infinity,
              fmt::format("{:g}", efficiency(0, 1e-8)), "infinity"));
}
