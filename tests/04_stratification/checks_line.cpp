// Checks of exercises 4.1 and 4.2. A mean over m independent estimates detects a bias of 8.74 sd /
// sqrt(m) with power .999 (compare.h).

#include "04_stratification/drawn.h"
#include "04_stratification/integrands.h"
#include "04_stratification/slips.h"
#include "04_stratification/theory.h"
#include "grader/judge/draws.h"
#include "grader/judge/judge.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

using namespace carlo::grader;
using namespace lab04_tests;

namespace {

const Diagnosis falls_anywhere{"points-not-stratified",
                               "the points fall anywhere: some strata get none, others several."};
const Diagnosis whole_division{"whole-number-division",
                               "all points lie in the first stratum: i/n of two whole numbers is a "
                               "whole number, 0."};
const Diagnosis no_jitter{"no-jitter",
                          "every point lies at the same place of its stratum in every run: that "
                          "is a quadrature rule, with its bias, and not a random estimate."};
const Diagnosis one_jitter{"one-jitter-for-all",
                           "all strata share one random number: their errors add up instead of "
                           "cancelling."};
const Diagnosis too_wide{"strata-over-n-minus-one",
                         "the strata are 1/(n-1) wide: the last one lies beyond 1."};
const Diagnosis whole_quotient{
    "whole-number-quotient",
    "the average is 0: 1/n of a whole number n is a whole number, 0 from "
    "n = 2 on."};
const Diagnosis not_divided{"sum-not-divided", "the sum of the values is not divided by n."};

const Diagnosis reaches_one{"float-reaches-one",
                            "the last stratum's points are rounded up to 1, which is outside [0, "
                            "1)."};
const Diagnosis leaves_above{"leaves-stratum-above",
                             "x is rounded up to the first place of the next stratum: keeping it "
                             "below 1 helps the last stratum only."};
const Diagnosis leaves_below{"leaves-stratum-below",
                             "x is rounded down to below i/n, where i/n is no float."};
const Diagnosis share_changed{"share-changed",
                              "u is no longer the relative position within the stratum: it has "
                              "been scaled, rounded coarsely or left out."};

/// The average of x^k from one point in each of n strata: its cumulants are those of the strata,
/// each with the weight 1/n.
Cumulants stratified_power(int k, int n) {
  Cumulants sum;
  for (int i = 0; i < n; ++i)
    sum.add(of_power(k, static_cast<double>(i) / n, (i + 1.0) / n), 1.0 / n);
  return sum;
}

/// The same from n points of [0, 1) without strata, and from one number shared by all strata.
double plain_variance(int k, int n) {
  return of_power(k, 0, 1).variance / n;
}

void judge_estimates(int k, int n) {
  const Rows rows =
      probe("Lab 4.1 estimates", {.n = n, .numbers = {{"k", k}, {"repetitions", 20'000}}},
            {.rows = 20'000, .of = fmt::format("f(x) = x^{}, n = {}", k, n)});
  const Theory theory = stratified_power(k, n).theory();
  double left_ends = 0, centres = 0;
  for (int i = 0; i < n; ++i) {
    left_ends += power(static_cast<double>(i) / n, k) / n;
    centres += power((i + 0.5) / n, k) / n;
  }
  const std::string which = fmt::format("estimates of the average of x^{}, n = {}", k, n);
  Suspects means{{left_ends, no_jitter}, {centres, no_jitter}, {theory.mean * n, not_divided}};
  if (n > 1) means.push_back({0, whole_quotient});
  judge(mean_is("the mean of " + which, rows.values, theory, means));
  Suspects variances{{0, no_jitter}};
  if (n > 1) variances.push_back({plain_variance(k, n), falls_anywhere});
  // With x^1 a shared number moves the estimate like a single point in one stratum.
  if (n > 1 && k == 1) variances.push_back({1.0 / 12 / n / n, one_jitter});
  judge(variance_is("the variance of " + which, rows.values, theory, variances));
}

/// One estimate. Its points are trusted as far as they follow from the seed.
struct Record {
  double value, asked;
  carlo::Rng before;
  NextWords next{};
  std::vector<double> points;
};

Record record(std::size_t n) {
  constexpr std::size_t head = 6;
  const Answer rows = probe("Lab 4.1 record", {.n = static_cast<std::int64_t>(n)},
                            {.rows = head + n, .finite = false});
  Record record{rows.values[0], rows.values[1], carlo::Rng(rows.seed), {}, {}};
  std::copy_n(rows.values.begin() + 2, record.next.size(), record.next.begin());
  record.points.assign(rows.values.begin() + head, rows.values.end());
  return record;
}

/// The relative position of each point in its stratum, from 0 to 1.
std::vector<double> within_strata(const std::vector<double>& points) {
  std::vector<double> within;
  for (const double x : points)
    within.push_back(std::fmod(x * static_cast<double>(points.size()), 1.0));
  return within;
}

/// The mistakes that explain points outside [0, 1): point i in stratum i of n - 1, or division of
/// only one part of i + u.
std::vector<Diagnosis> sign_of_outside(const std::vector<double>& points) {
  const auto n = static_cast<double>(points.size());
  bool wide = true, share_alone = true, number_alone = true;
  for (std::size_t k = 0; k < points.size(); ++k) {
    const auto i = static_cast<double>(k);
    const double in_wider = points[k] * (n - 1) - i;
    wide = wide && in_wider > -1e-9 && in_wider < 1 + 1e-9;
    share_alone = share_alone && is_share_divided_alone(points[k], i, n);
    number_alone = number_alone && is_number_divided_alone(points[k], i, n);
  }
  if (wide) return {too_wide};
  return share_alone || number_alone ? std::vector{one_part_divided} : std::vector<Diagnosis>{};
}

/// A requested position and the returned one.
struct Place {
  Share share;
  double x;
};

std::vector<Place> places(std::int32_t n) {
  constexpr std::int64_t count = 30'000;
  const Answer rows = probe("Lab 4.2 places", {.n = n, .numbers = {{"places", count}}},
                            {.rows = count, .finite = false});
  std::vector<Place> places;
  for (const Share& share : drawn_shares(rows.seed, n, count))
    places.push_back({share, rows.values[places.size()]});
  return places;
}

/// The mistakes that explain positions far from the right ones.
std::vector<Diagnosis> sign_of(const std::vector<Place>& places, std::int32_t n) {
  bool share_alone = true, number_alone = true, whole = true;
  for (const auto& [share, x] : places) {
    const double i = share.stratum, u = share.u, n_strata = n;
    const auto near = [place = x](double other) {
      return std::abs(place - other) <= 1e-6 * std::abs(other) + 1e-30;
    };
    share_alone = share_alone && near(i + u / n_strata);
    number_alone = number_alone && near(i / n_strata + u);
    whole = whole && near(u / n_strata);
  }
  if (share_alone || number_alone) return {one_part_divided};
  return whole ? std::vector{whole_division} : std::vector<Diagnosis>{};
}

}  // namespace

TEST_CASE("Lab 4.1: each stratum holds exactly one point, and the values are averaged",
          "[lab04][ex1]") {
  for (const std::size_t n : {1U, 7U, 4096U}) {
    const Record of = record(n);
    const double count = static_cast<double>(n);
    judge(equals("the number of evaluations of f", of.asked, count, 0));
    judge(draws(of.before, of.next, count));
    std::vector<int> held(n, 0);
    int outside = 0;
    double sum = 0;
    for (const double x : of.points) {
      sum += x * x;
      if (x >= 0 && x < 1) {
        ++held[static_cast<std::size_t>(x * count)];
      } else {
        ++outside;
      }
    }
    const auto missed = std::count(held.begin(), held.end(), 0);
    judge(holds(fmt::format("points outside [0, 1), n = {}", n), outside == 0,
                fmt::format("{}", outside), "none", sign_of_outside(of.points)));
    if (outside == 0) {
      judge(holds(fmt::format("strata without a point, n = {}", n), missed == 0,
                  fmt::format("{}", missed), "none",
                  {n > 1 && held[0] == static_cast<int>(n) ? whole_division : falls_anywhere}));
      judge(made_of(fmt::format("where the points lie in their strata, n = {}", n),
                    within_strata(of.points), of.before));
    }
    Suspects suspects{{sum, not_divided}};
    if (n > 1) suspects.push_back({0, whole_quotient});
    judge(equals("the estimate against the values of f at its points", of.value, sum / count,
                 1e-12 * sum / count, suspects));
  }
}

// sd of one estimate at n = 8: .0128 (x), .0145 (x^2): 20 000 of them detect a bias of 9e-4, .2 %.
// Variances that are off by 9 % are detected; that of plain points is 64 times as large for x.
TEST_CASE("Lab 4.1: the average is unbiased, with the variance that strata leave", "[lab04][ex1]") {
  judge_estimates(1, 8);
  judge_estimates(2, 8);
  judge_estimates(2, 1);
}

// Kolmogorov-Smirnov on 4096 positions within their strata: detects distances of .058 with power
// .999.
TEST_CASE("Lab 4.1: within its stratum a point may lie anywhere, equally likely", "[lab04][ex1]") {
  const std::vector<double> within = within_strata(record(4096).points);
  const auto [least, most] = std::minmax_element(within.begin(), within.end());
  // If all are the same, another run shows whether they are random.
  const double again = within_strata(record(4096).points).front();
  const bool on_every_run = std::abs(again - within.front()) <= 1e-6;
  judge(holds("the places within the strata differ", *most - *least > 0.5,
              fmt::format("from {:.6g} to {:.6g} of a stratum", *least, *most), "from 0 to 1",
              {on_every_run ? no_jitter : one_jitter}));
  judge(uniform_on("the places within the strata", within, 0, 1));
}

// Exact for every position: x n needs 24 + 21 bits, which double has.
TEST_CASE("Lab 4.2: x lies in its stratum, at both ends and up to 2^20 strata", "[lab04][ex2]") {
  for (const std::int32_t n : {1, 3, 49, 1000, 65'535, 1 << 20, (1 << 20) - 1}) {
    int no_numbers = 0, ones = 0, above = 0, below = 0;
    const std::vector<Place> found = places(n);
    const std::vector<Diagnosis> sign = sign_of(found, n);
    for (const auto& [share, x] : found) {
      const double i = share.stratum;
      if (!std::isfinite(x)) {
        ++no_numbers;
      } else if (x >= 1) {
        ++ones;
      } else if (!(x * n < i + 1)) {
        ++above;
      } else if (!(x * n >= i)) {
        ++below;
      }
    }
    const auto tell = [&](const std::string& what, int count, const Diagnosis& otherwise) {
      judge(holds(fmt::format("{} of 30 000, n = {}", what, n), count == 0,
                  fmt::format("{}", count), "none", sign.empty() ? std::vector{otherwise} : sign));
    };
    judge(holds(fmt::format("places that are no numbers of 30 000, n = {}", n), no_numbers == 0,
                fmt::format("{}", no_numbers), "none"));
    tell("places at 1 or above", ones, reaches_one);
    tell("places above their stratum", above, leaves_above);
    tell("places below their stratum", below, leaves_below);
  }
}

// Neighbouring floats are at most 2^-23 x apart. Rounding to nearest takes half of that and a step
// back into the stratum the rest; float arithmetic with such steps needs no more than four.
TEST_CASE("Lab 4.2: x is (i + u)/n to float precision", "[lab04][ex2]") {
  for (const std::int32_t n : {1, 7, 1000, 1 << 20}) {
    double worst = 0;
    const std::vector<Place> found = places(n);
    const std::vector<Diagnosis> sign = sign_of(found, n);
    for (const auto& [share, x] : found) {
      const double exact = (static_cast<double>(share.stratum) + share.u) / n;
      const double allowed = 0x1p-23 * exact + 0x1p-60;
      const double off = std::abs(x - exact) / allowed;
      worst = off <= worst ? worst : off;
    }
    judge(holds(fmt::format("the largest error, n = {}", n), worst <= 4,
                fmt::format("{:.3g} floats", worst), "at most 4 floats",
                sign.empty() ? std::vector{share_changed} : sign));
  }
}
