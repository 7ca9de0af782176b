// Checks of exercises 2.1 and 2.2. A mean of m values detects a shift of 8.74 sd / sqrt(m) with
// power .999 (compare.h); the size is stated at each test.

#include "02_pi/drawn.h"
#include "02_pi/reference.h"
#include "02_pi/theory.h"
#include "grader/judge/judge.h"
#include "grader/protocol/next_words.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

using namespace carlo::grader;
using namespace lab02_tests;

namespace {

const Diagnosis same_number{"one-number-for-x-and-y",
                            "x and y come from the same random number: the darts lie on the "
                            "diagonal."};
const Diagnosis triangle{"square-root-or-squares-missing",
                         "half of the darts hit: the test looks like x + y < 1, not like "
                         "x^2 + y^2 < 1."};
const Diagnosis x_against_y{"x-compared-with-y",
                            "half of the darts hit: x is compared with y, and nothing with the "
                            "circle."};
const Diagnosis float_counter{"float-counter",
                              "the hits stop at 16777216 = 2^24: a float cannot count further. "
                              "Count in whole numbers."};
const Diagnosis not_scaled{"share-not-scaled-to-pi",
                           "the share of hits, π/4, or an error of it, is given: the factor 4 is "
                           "missing."};
const Diagnosis whole_numbers{"division-of-whole-numbers",
                              "hits / thrown of two whole numbers is a whole number, 0 here: make "
                              "one of them a double before you divide."};
const Diagnosis error_not_scaled{"standard-error-not-scaled",
                                 "the standard error is that of the share of hits; π is 4 times "
                                 "the share, and so is its error."};
const Diagnosis four_below_root{"standard-error-scaled-below-the-root",
                                "the factor 4 is inside the root: it belongs outside, or is 16 "
                                "inside, since a variance scales with the square."};
const Diagnosis error_of_one_dart{
    "standard-error-of-one-dart",
    "the standard deviation of one dart is given; that of the mean is "
    "smaller by sqrt(N)."};
const Diagnosis variance_for_error{"variance-in-place-of-standard-error",
                                   "the variance is given: its square root is the standard error."};
const Diagnosis darts_by_n{"variance-divided-by-n",
                           "the variance is divided by N; the unbiased estimate takes N - 1."};
const Diagnosis normal_interval{"interval-of-the-measured-variance",
                                "the estimate ± z standard errors is given, with a width "
                                "computed from the measured share: with no hit, or no miss, the "
                                "width is 0."};
const Diagnosis interval_not_scaled{
    "interval-not-scaled-to-pi", "the limits are those of the share of hits; π is 4 times that."};
const Diagnosis not_shrunk{"interval-not-divided",
                           "the division by 1 + z^2/N is missing: the coefficient of p^2 in the "
                           "quadratic equation is not 1."};

const Diagnosis swapped{"limits-swapped", "the lower and the upper limit are swapped."};
const Diagnosis centre_moved_twice{
    "centre-moved-twice",
    "the centre is moved by z^2/N where the quadratic equation gives z^2/(2N)."};
const Diagnosis centre_moved_half{
    "centre-moved-half",
    "the centre is moved by z^2/(4N) where the quadratic equation gives z^2/(2N)."};
const Diagnosis root_term_by_n{"root-term-over-n",
                               "below the root stands z^2/(4 N): the quadratic equation gives "
                               "z^2/(4 N^2)."};
const Diagnosis z_not_squared{"z-not-squared",
                              "the centre is moved by z/(2N) where the quadratic equation gives "
                              "z^2/(2N)."};
const Diagnosis root_short{"root-without-its-second-term",
                           "z^2/(4 N^2) is missing below the root."};

struct Interval {
  double lower, upper;
};

struct Case {
  double thrown, hits;
};

/// "1 hit of 2".
std::string hits_of_thrown(Case darts) {
  return fmt::format("{} of {}", counted(darts.hits, "hit"), number_in_report(darts.thrown));
}

/// The hits by other tests than the circle's; few darts do not tell them apart.
Suspects other_hits(std::int64_t n, carlo::Rng rng) {
  double below = 0, above = 0, under_line = 0;
  for (std::int64_t i = 0; i < n; ++i) {
    const double x = rng.uniform();
    const double y = rng.uniform();
    below += y < x ? 1 : 0;
    above += x < y ? 1 : 0;
    under_line += x + y < 1 ? 1 : 0;
  }
  if (n < 100) return {};
  return {{below, x_against_y}, {above, x_against_y}, {under_line, triangle}};
}

void judge_estimate(Case darts) {
  const Rows rows =
      probe("Lab 2.1 estimate", {.numbers = {{"thrown", darts.thrown}, {"hits", darts.hits}}},
            {.columns = 2, .finite = false});
  const std::string of = hits_of_thrown(darts);
  const double share = darts.hits / darts.thrown;
  const double variance = share * (1 - share);
  const double n1 = darts.thrown - 1;
  const double error = darts.thrown < 2 ? 0 : 4 * std::sqrt(variance / n1);
  Suspects suspects;
  if (error > 0) {
    const bool value_too = std::abs(rows.at(0, 0) - share) <= 1e-12;
    suspects = {{error / 4, value_too ? not_scaled : error_not_scaled},
                {error / 2, four_below_root},
                {4 * std::sqrt(variance), error_of_one_dart},
                {4 * std::sqrt(variance * darts.thrown / n1), error_of_one_dart},
                {error * error, variance_for_error},
                {4 * std::sqrt(variance / darts.thrown), darts_by_n}};
    if (rows.at(0, 0) == 4 * std::floor(share)) suspects.push_back({0, whole_numbers});
  }
  judge(equals("the estimate from " + of, rows.at(0, 0), 4 * share, 1e-12,
               {{share, not_scaled},
                {4 * std::floor(share), whole_numbers},
                {std::floor(4 * share), whole_numbers}}));
  judge(equals("the standard error from " + of, rows.at(0, 1), error, 1e-12, suspects));
}

/// The estimate ± z standard errors, for π.
Interval normal_limits(Case darts, double z) {
  const double share = darts.hits / darts.thrown;
  const double half = z * std::sqrt(share * (1 - share) / darts.thrown);
  return {4 * (share - half), 4 * (share + half)};
}

/// The mistakes that explain both of these limits; one limit alone fits many.
std::vector<Diagnosis> interval_diagnoses(Interval measured, Case darts, double z) {
  const ScoreLimits share = score_limits(darts.thrown, darts.hits, z);
  const Interval normal = normal_limits(darts, z);
  const double undivided = 4 * (1 + z * z / darts.thrown);
  const double hits = darts.hits / darts.thrown, shift = z * z / darts.thrown;
  const double root = z * std::sqrt(hits * (1 - hits) / darts.thrown);
  const double root_by_n = z * std::sqrt(hits * (1 - hits) / darts.thrown + shift / 4);
  const double right_root = (share.upper - share.lower) / 2 * (1 + shift);
  const auto around = [&](double centre, double half) {
    return Interval{4 * (centre - half) / (1 + shift), 4 * (centre + half) / (1 + shift)};
  };
  const std::array<std::pair<Interval, Diagnosis>, 10> mistakes = {
      {{normal, normal_interval},
       {{std::max(0.0, normal.lower), std::min(4.0, normal.upper)}, normal_interval},
       {{share.lower, share.upper}, interval_not_scaled},
       {{undivided * share.lower, undivided * share.upper}, not_shrunk},
       {{4 * share.upper, 4 * share.lower}, swapped},
       {around(hits + shift, right_root), centre_moved_twice},
       {around(hits + shift / 4, right_root), centre_moved_half},
       {around(hits + shift / 2, root_by_n), root_term_by_n},
       {around(hits + z / darts.thrown / 2, right_root), z_not_squared},
       {around(hits + shift / 2, root), root_short}}};
  const auto far = [](const Interval& a, const Interval& b, double by) {
    return std::abs(a.lower - b.lower) > by || std::abs(a.upper - b.upper) > by;
  };
  for (const auto& [limits, diagnosis] : mistakes) {
    // For very many darts all formulas give nearly the same.
    if (!far(measured, limits, 1e-9) && far(limits, {4 * share.lower, 4 * share.upper}, 1e-6)) {
      return {diagnosis};
    }
  }
  return {};
}

void judge_limits(Interval measured, Case darts, double z) {
  const ScoreLimits share = score_limits(darts.thrown, darts.hits, z);
  const std::string of = fmt::format("{}, z = {:g}", hits_of_thrown(darts), z);
  Verdict lower = equals("the lower limit from " + of, measured.lower, 4 * share.lower, 1e-9);
  Verdict upper = equals("the upper limit from " + of, measured.upper, 4 * share.upper, 1e-9);
  for (Verdict* limit : {&lower, &upper}) {
    if (!limit->passed) {
      limit->diagnoses = interval_diagnoses(measured, darts, z);
      limit->looked_for = {normal_interval, interval_not_scaled, not_shrunk,
                           swapped,         centre_moved_twice,  centre_moved_half,
                           root_term_by_n,  z_not_squared,       root_short};
    }
    judge(*limit);
  }
}

void judge_interval(Case darts, double z) {
  const Rows rows = probe("Lab 2.2 interval",
                          {.numbers = {{"thrown", darts.thrown}, {"hits", darts.hits}, {"z", z}}},
                          {.columns = 2, .finite = false});
  judge_limits({rows.at(0, 0), rows.at(0, 1)}, darts, z);
}

}  // namespace

TEST_CASE("Lab 2.1: every dart takes two numbers, x and y, and is judged by them", "[lab02][ex1]") {
  for (const std::int64_t n : {0, 1, 2, 1000, 100'000}) {
    const Answer rows = probe("Lab 2.1 record", {.n = n}, {.columns = 6});
    const auto count = static_cast<double>(n);
    const carlo::Rng before(rows.seed);
    carlo::Rng rng = before;
    const auto hits = static_cast<double>(hits_of(n, rng));
    const NextWords next{rows.at(0, 2), rows.at(0, 3), rows.at(0, 4), rows.at(0, 5)};
    const double drawn = words_drawn(before, next, 8 * n + 64);
    judge(equals("the darts thrown", rows.at(0, 0), count, 0));
    judge(equals("the hits among " + counted(count, "dart"), rows.at(0, 1), hits, 0,
                 other_hits(n, before)));
    // A uniform double takes two of the generator's 32-bit words.
    judge(equals("the numbers drawn (calls of rng.uniform())", drawn / 2, 2 * count, 0));
  }
}

// 320 000 darts: a hit rate that is off by .0063 is detected; the mistakes below are off by .078
// and more. 20 000 counts detect a variance that is off by 9 %.
TEST_CASE("Lab 2.1: the share of hits is π/4 with the variance of independent darts",
          "[lab02][ex1]") {
  const Rows rows =
      probe("Lab 2.1 repeated", {.n = 16, .numbers = {{"repetitions", 20'000}}}, {.rows = 20'000});
  const Theory theory = hits_theory(16);
  judge(mean_is("the hits among 16 darts", rows.values, theory,
                {{16 / std::sqrt(2.0), same_number}, {8, triangle}, {8, x_against_y}}));
  judge(variance_is("the variance of the hits", rows.values, theory));
}

// 22 million darts have 17.28 million hits with a standard deviation of 1925: 260 of these above
// the last number that a float can count to. A count that is 16 800 off is detected.
TEST_CASE("Lab 2.1: many darts are counted as well as few", "[lab02][ex1]") {
  const Rows rows = probe("Lab 2.1 many", {.n = 22'000'000}, {.columns = 2});
  const std::vector<double> hits = column(rows, 1);
  judge(equals("the darts thrown", rows.at(0, 0), 22e6, 0, {{16777216, float_counter}}));
  judge(mean_is("the hits among 22 million darts", hits, hits_theory(22e6),
                {{16777216, float_counter}}));
}

TEST_CASE("Lab 2.1: the estimate of π and its standard error", "[lab02][ex1]") {
  for (const Case darts : {Case{1000, 785}, Case{10, 7}, Case{2, 1}, Case{3e9, 2356194490}})
    judge_estimate(darts);
}

TEST_CASE("Lab 2.1: one dart has no standard error, and equal scores have none either",
          "[lab02][ex1]") {
  for (const Case darts : {Case{1, 1}, Case{1, 0}, Case{50, 50}, Case{50, 0}})
    judge_estimate(darts);
}

TEST_CASE("Lab 2.2: the limits lie z of their own standard deviations from the share of hits",
          "[lab02][ex2]") {
  for (const double z : {1.0, 1.959963984540054, 5.0}) {
    judge_interval({1000, 785}, z);
    judge_interval({10, 7}, z);
    judge_interval({4e9, 3141592654}, z);
  }
}

TEST_CASE("Lab 2.2: the limits of drawn numbers of darts, at drawn z", "[lab02][ex2]") {
  constexpr std::int64_t n = 12;
  const Answer rows = probe("Lab 2.2 drawn intervals", {.n = n}, {.rows = n, .columns = 2});
  const std::vector<IntervalQuestion> asked = drawn_intervals(rows.seed, n);
  for (std::size_t i = 0; i < rows.count(); ++i) {
    const Case darts{static_cast<double>(asked[i].thrown), static_cast<double>(asked[i].hits)};
    judge_limits({rows.at(i, 0), rows.at(i, 1)}, darts, asked[i].z);
  }
}

TEST_CASE("Lab 2.2: without a hit, or without a miss, the interval has a width", "[lab02][ex2]") {
  for (const Case darts : {Case{1, 0}, Case{1, 1}, Case{10, 0}, Case{10, 10}, Case{1e6, 0}})
    judge_interval(darts, 1.959963984540054);
}

// 10 000 intervals each: with power .999 a coverage of .95 that is off by .019 is detected. The
// expected coverage is exact, a sum over all counts of hits: it is .95 only on average.
TEST_CASE("Lab 2.2: 95 % intervals hold the true value in the share of cases that theory says",
          "[lab02][ex2]") {
  constexpr double z = 1.959963984540054;
  struct Setting {
    int n;
    double p;
  };
  for (const Setting s :
       {Setting{10, quarter_disc}, Setting{1000, quarter_disc}, Setting{50, .02}}) {
    const Rows rows = probe("Lab 2.2 intervals",
                            {.n = s.n, .numbers = {{"repetitions", 10'000}, {"p", s.p}, {"z", z}}},
                            {.rows = 10'000, .columns = 2});
    std::vector<double> covered;
    for (std::size_t i = 0; i < rows.count(); ++i)
      covered.push_back(rows.at(i, 0) <= 4 * s.p && 4 * s.p <= rows.at(i, 1) ? 1 : 0);
    const double exact = coverage(s.n, s.p, [&](int k) {
      const ScoreLimits limits = score_limits(s.n, k, z);
      return limits.lower <= s.p && s.p <= limits.upper;
    });
    const double normal = coverage(s.n, s.p, [&](int k) {
      const Interval limits = normal_limits({static_cast<double>(s.n), static_cast<double>(k)}, z);
      return limits.lower <= 4 * s.p && 4 * s.p <= limits.upper;
    });
    judge(mean_is(fmt::format("the share of intervals that hold {:.4g}, N = {}", 4 * s.p, s.n),
                  covered, {exact, std::sqrt(exact * (1 - exact))}, {{normal, normal_interval}}));
  }
}
