// Checks of exercises 1.1 and 1.2. A mean over m evaluations in all detects a bias of 8.74 sd /
// sqrt(m) with power .999 (compare.h); the size is stated at each test.

#include "01_integration/integrands.h"
#include "01_integration/slips.h"
#include "01_integration/theory.h"
#include "grader/judge/draws.h"
#include "grader/judge/judge.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

using namespace carlo::grader;
using namespace lab01_tests;

namespace {

const Diagnosis by_n_plus_one{"divides-by-n-plus-one",
                              "the sum of n values is divided by n + 1 and not by n."};
const Diagnosis by_n_minus_one{
    "divides-by-n-minus-one",
    "the sum of n values is divided by n - 1 and not by n: n - 1 belongs to a variance, not to a "
    "mean."};
const Diagnosis term_too_many{"one-term-too-many",
                              "one term too many is added: f is evaluated n + 1 times, not n. "
                              "Look at where the loop begins and where it ends."};
const Diagnosis not_divided{"sum-not-divided", "the sum of the values is not divided by n."};
const Diagnosis float_sum{"float-accumulation",
                          "the sum is kept in a float somewhere: 7 digits are not enough."};
const Diagnosis width_missing{"missing-interval-width",
                              "the average over [a, b) is not yet the integral: the width b - a is "
                              "missing."};
const Diagnosis over_width{"divided-by-interval-width",
                           "the average over [a, b) is divided by the width b - a: the integral is "
                           "the average times the width."};
const Diagnosis wrong_points{"points-outside-interval",
                             "f is evaluated outside the interval: check how [0, 1) is mapped to "
                             "it."};
const Diagnosis repeated{"one-point-repeated",
                         "the error does not fall as n grows: the n points are not independent."};

const Diagnosis stratified{"points-stratified",
                           "exactly one point falls into each n-th of the interval; n independent "
                           "points leave some of these empty and others with several."};
const Diagnosis even_points{"points-evenly-spaced",
                            "the points are evenly spaced, like those of a quadrature rule: each "
                            "of them has to be random by itself."};

struct Interval {
  double a = 0, b = 1;
};

/// A probe's question, for messages.
std::string powers(int k, double n, Interval on = {}) {
  return fmt::format("f(x) = x^{}, n = {:g}, on [{:g}, {:g})", k, n, on.a, on.b);
}

/// One estimate from n points. Its points are trusted as far as they follow from the seed.
struct Record {
  double value = 0, count = 0;
  NextWords next{};
  std::vector<double> points;
  carlo::Rng before;

  /// The mean of x^k at the points.
  double mean(int k) const {
    long double sum = 0;
    for (const double x : points)
      sum += power(x, k);
    return static_cast<double>(sum / static_cast<long double>(points.size()));
  }
};

Record record(const std::string& name, const Params& params, const std::string& of) {
  constexpr std::size_t head = 6;
  const Answer rows = probe(
      name, params, {.rows = head + static_cast<std::size_t>(params.n), .finite = false, .of = of});
  Record record{rows.values[0], rows.values[1], {}, {}, carlo::Rng(rows.seed)};
  std::copy_n(rows.values.begin() + 2, record.next.size(), record.next.begin());
  record.points.assign(rows.values.begin() + head, rows.values.end());
  return record;
}

/// The estimate is `scale` times the mean of x^k at the points, up to rounding (1e-12: n additions
/// lose 1e-13 in double and 1e-6 in float).
Verdict is_mean_of_values(const Record& of, int k, double scale) {
  const double mean = of.mean(k), expected = scale * mean;
  const auto n = static_cast<double>(of.points.size());
  const std::string what = "the estimate against the values of f at its points";
  // It may be a mean of more values than are known here.
  if (of.count != n) return equals(what, of.value, expected, 1e-12 * std::abs(expected));
  Suspects suspects{
      {expected * n / (n + 1), by_n_plus_one}, {expected * n, not_divided}, of_whole_division(n)};
  if (n > 1) suspects.push_back({expected * n / (n - 1), by_n_minus_one});
  if (std::abs(scale - 1) > 1e-9)
    suspects.insert(suspects.end(), {{mean, width_missing}, {mean / scale, over_width}});
  Verdict verdict = equals(what, of.value, expected, 1e-12 * std::abs(expected), suspects);
  if (n == 1 && std::isinf(of.value)) verdict.diagnoses.push_back(by_n_minus_one);
  const bool near = std::abs(of.value - expected) <= 1e-5 * std::abs(expected);
  if (!verdict.passed && near) verdict.diagnoses.push_back(float_sum);
  return verdict;
}

Verdict within(const std::vector<double>& points, Interval on) {
  const auto [lowest, highest] = std::minmax_element(points.begin(), points.end());
  return holds("the points that f is evaluated at", *lowest >= on.a && *highest < on.b,
               fmt::format("from {:.6g} to {:.6g}", *lowest, *highest),
               fmt::format("all within [{:g}, {:g})", on.a, on.b), {wrong_points});
}

/// `suspects` for a mean. But if the values scatter so much more than they should that this alone
/// explains a wrong mean, the scatter is reported.
Suspects unless_scattered(std::span<const double> values, const Theory& theory,
                          const Suspects& suspects) {
  const auto count = static_cast<double>(values.size());
  double mean = 0, squares = 0;
  for (const double value : values)
    mean += value / count;
  for (const double value : values)
    squares += (value - mean) * (value - mean) / count;
  const bool wide = squares > 2 * theory.sd * theory.sd;
  const bool near = std::abs(mean - theory.mean) <= 6 * std::sqrt(squares / count);
  return wide && near ? Suspects{{theory.mean, repeated}} : suspects;
}

/// Diagnoses points that do not come from random numbers, by their relative positions in the
/// interval: random points would not each have an n-th of their own.
std::vector<Diagnosis> not_independent(std::vector<double> shares) {
  const auto n = static_cast<double>(shares.size());
  if (n < 16) return {};
  std::sort(shares.begin(), shares.end());
  bool one_each = true, even = true;
  for (std::size_t i = 0; i < shares.size(); ++i) {
    const double place = shares[i] * n - static_cast<double>(i);
    one_each = one_each && place >= 0 && place < 1;
    even = even && std::abs(place - shares[0] * n) <= 1e-6;
  }
  if (even) return {even_points};
  return one_each ? std::vector{stratified} : std::vector<Diagnosis>{};
}

/// If there is one term too many, all deviations follow from that.
Verdict following(Verdict verdict, const Record& of) {
  const bool too_many = of.count == static_cast<double>(of.points.size()) + 1;
  if (too_many && !verdict.passed) verdict.diagnoses = verdict.looked_for = {term_too_many};
  return verdict;
}

/// Requirements on every estimate: n evaluations in the interval, at points from the generator.
void judge_record(const Record& of, int k, Interval on) {
  const auto n = static_cast<double>(of.points.size());
  judge(equals("the number of evaluations of f", of.count, n, 0, {{n + 1, term_too_many}}));
  if (of.count < n) return;  // missing points would be reported as wrong ones
  judge(within(of.points, on));
  std::vector<double> shares = of.points;
  for (double& x : shares)
    x = (x - on.a) / (on.b - on.a);
  Verdict places = made_of("where the points lie in the interval", shares, of.before);
  if (!places.passed) places.diagnoses = not_independent(shares);
  judge(places);
  judge(following(is_mean_of_values(of, k, on.b - on.a), of));
  judge(following(draws(of.before, of.next, n), of));
}

Rows integrals(double n, double repetitions, int k, Interval on) {
  return probe("Lab 1.2 estimates",
               {.n = static_cast<std::int64_t>(n),
                .numbers = {{"repetitions", repetitions}, {"k", k}, {"a", on.a}, {"b", on.b}}},
               {.rows = static_cast<std::size_t>(repetitions), .of = powers(k, n, on)});
}

void judge_integral(int k, Interval on, double n, double repetitions) {
  const Rows rows = integrals(n, repetitions, k, on);
  const double width = on.b - on.a;
  const Theory theory = theory_of_mean(power_moments(k, on.a, on.b), n, width);
  // A map from [0, 1) to [a, a + b) is the usual mistake.
  const double shifted = width * power_mean(k, on.a, on.a + on.b);
  Suspects suspects{{theory.mean / width, width_missing},
                    {theory.mean / (width * width), over_width},
                    {shifted, wrong_points}};
  if (n > 1) {  // for a single point these look like a wrong width
    suspects.push_back({theory.mean * n / (n + 1), by_n_plus_one});
    suspects.push_back({theory.mean * n / (n - 1), by_n_minus_one});
    suspects.push_back({theory.mean * (n + 1) / n, term_too_many});
    suspects.push_back({theory.mean * n, not_divided});
    suspects.push_back(of_whole_division(n));
  }
  judge(mean_is(fmt::format("the integral of x^{} over [{:g}, {:g}], n = {:g}", k, on.a, on.b, n),
                rows.values, theory, unless_scattered(rows.values, theory, suspects)));
  const double variance = theory.sd * theory.sd;
  judge(variance_is("the variance of the estimates", rows.values, theory,
                    {{variance * n, repeated}}));
}

}  // namespace

TEST_CASE("Lab 1.1: f is evaluated n times and its values are averaged", "[lab01][ex1]") {
  for (const std::int64_t n : {1, 16, 4096}) {
    judge_record(record("Lab 1.1 record", {.n = n, .numbers = {{"k", 2}}},
                        powers(2, static_cast<double>(n))),
                 2, {0, 1});
  }
}

// cv of x^2 is .894 and of x^5 1.51; 320 000 evaluations per test detect a bias of 1.4 % (2.3 %); n
// + 1 in place of n is one of 5.9 %. 20 000 estimates detect a variance that is off by 9 %.
TEST_CASE("Lab 1.1: the average from 0 to 1 is unbiased", "[lab01][ex1]") {
  for (const int k : {2, 5}) {
    const Rows rows =
        probe("Lab 1.1 estimates", {.n = 16, .numbers = {{"repetitions", 20'000}, {"k", k}}},
              {.rows = 20'000, .of = powers(k, 16)});
    const Theory theory = theory_of_mean(power_moments(k, 0, 1), 16);
    const Suspects suspects{{theory.mean * 16 / 17, by_n_plus_one},
                            {theory.mean * 16 / 15, by_n_minus_one},
                            {theory.mean * 17 / 16, term_too_many},
                            {theory.mean * 16, not_divided},
                            of_whole_division(16)};
    judge(mean_is(fmt::format("the average of x^{}, n = 16", k), rows.values, theory,
                  unless_scattered(rows.values, theory, suspects)));
  }
}

TEST_CASE("Lab 1.1: the variance of the average is that of one value divided by n",
          "[lab01][ex1][variance]") {
  for (const std::int64_t n : {1, 16, 256}) {
    const Rows rows =
        probe("Lab 1.1 estimates", {.n = n, .numbers = {{"repetitions", 20'000}, {"k", 2}}},
              {.rows = 20'000, .of = powers(2, static_cast<double>(n))});
    const auto count = static_cast<double>(n);
    const Theory theory = theory_of_mean(power_moments(2, 0, 1), count);
    judge(variance_is(fmt::format("the variance of the estimates, n = {}", n), rows.values, theory,
                      {{theory.sd * theory.sd * count, repeated}}));
  }
}

// 100 000 points: a distribution function that is off by .02 anywhere is detected with power .999.
TEST_CASE("Lab 1.1: the points are uniform from 0 to 1", "[lab01][ex1]") {
  const Rows rows = probe("Lab 1.1 points", {.n = 100'000}, {.rows = 100'000, .finite = false});
  judge(uniform_on("the points that f is evaluated at", rows.values, 0, 1));
}

TEST_CASE("Lab 1.2: f is evaluated n times between a and b and the width is counted once",
          "[lab01][ex2]") {
  for (const Interval on : {Interval{1, 3}, Interval{-4, -3.5}, Interval{-1, 2}}) {
    judge_record(
        record("Lab 1.2 record", {.n = 4096, .numbers = {{"k", 2}, {"a", on.a}, {"b", on.b}}},
               powers(2, 4096, on)),
        2, on);
  }
}

// The largest cv is 1.10 (x^2 on [-2, 1]: mean 1, sd 1.095); 320 000 evaluations detect a bias of
// 1.7 % in all four; n + 1 in place of n is one of 5.9 %.
TEST_CASE("Lab 1.2: the integral from a to b is unbiased", "[lab01][ex2]") {
  judge_integral(2, {1, 3}, 16, 20'000);
  judge_integral(2, {-2, 1}, 16, 20'000);
  judge_integral(1, {-5, -2}, 16, 20'000);
  judge_integral(3, {0.25, 0.5}, 16, 20'000);
}

TEST_CASE("Lab 1.2: one point gives an estimate, unbiased too", "[lab01][ex2]") {
  judge_integral(2, {1, 3}, 1, 100'000);
}

TEST_CASE("Lab 1.2: an empty interval gives 0", "[lab01][ex2]") {
  const Rows rows = integrals(16, 1, 2, {3, 3});
  judge(equals("the integral over [3, 3]", rows.at(0, 0), 0, 0));
}

TEST_CASE("Lab 1.2: the points are uniform from a to b", "[lab01][ex2]") {
  const Rows rows = probe("Lab 1.2 points", {.n = 100'000, .numbers = {{"a", -3}, {"b", 5}}},
                          {.rows = 100'000, .finite = false});
  judge(uniform_on("the points that f is evaluated at", rows.values, -3, 5));
}
