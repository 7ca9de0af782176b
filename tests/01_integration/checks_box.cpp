// Checks of exercise 1.6. For sizes and power see checks_average.cpp.

#include "01_integration/dimensions.h"
#include "01_integration/integrands.h"
#include "01_integration/points.h"
#include "01_integration/slips.h"
#include "01_integration/theory.h"
#include "grader/judge/draws.h"
#include "grader/judge/judge.h"

#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

using namespace carlo::grader;
using namespace lab01_tests;

namespace {

/// For all probes of this lab.
const Unsaid unsaid{"domain", "integrand", "pattern", "rule"};

const Diagnosis one_side{"volume-of-one-dimension",
                         "the average is multiplied by one side of the box and not by all."};
const Diagnosis outside_box{"points-outside-box", "f is evaluated outside the box."};

double box_volume(int d) {
  double product = 1;
  for (std::size_t i = 0; i < static_cast<std::size_t>(d); ++i)
    product *= upper(i) - lower(i);
  return product;
}

double sum_of_box_sides(int d) {
  double sum = 0;
  for (std::size_t i = 0; i < static_cast<std::size_t>(d); ++i)
    sum += upper(i) - lower(i);
  return sum;
}

/// Moments of the product of the coordinates: raw moments of independent factors multiply.
RawMoments product_moments(int d) {
  RawMoments all{1, 1, 1, 1};
  for (std::size_t i = 0; i < static_cast<std::size_t>(d); ++i) {
    const RawMoments one = power_moments(1, lower(i), upper(i));
    all = {all.m1 * one.m1, all.m2 * one.m2, all.m3 * one.m3, all.m4 * one.m4};
  }
  return all;
}

/// For the mean of n values of sum (i + 1) x_i^2, times the volume: cumulants of independent
/// summands add.
Theory squares_theory(int d, double n) {
  double mean = 0, variance = 0, fourth = 0;
  for (std::size_t i = 0; i < static_cast<std::size_t>(d); ++i) {
    const Theory one = theory_of_mean(power_moments(2, lower(i), upper(i)), 1);
    const double weight = static_cast<double>(i + 1);
    const double part = weight * weight * one.sd * one.sd;
    mean += weight * one.mean;
    variance += part;
    fourth += part * part * one.excess_kurtosis;
  }
  const double volume = box_volume(d);
  return {volume * mean, volume * std::sqrt(variance / n), fourth / (variance * variance) / n};
}

/// The mean of the product when all coordinates share one number, by fine midpoint sums.
double diagonal_product(int d) {
  constexpr int cells = 2000;
  double sum = 0;
  for (int cell = 0; cell < cells; ++cell) {
    double product = 1;
    for (std::size_t i = 0; i < static_cast<std::size_t>(d); ++i) {
      product *= lower(i) + (upper(i) - lower(i)) * (cell + 0.5) / cells;
    }
    sum += product;
  }
  return sum / cells;
}

void judge_box(BoxIntegrand integrand, int d) {
  constexpr double n = 16, repetitions = 20'000;
  const Rows rows = probe("Lab 1.6 estimates",
                          {.n = 16,
                           .numbers = {{"d", d},
                                       {"integrand", static_cast<double>(integrand)},
                                       {"repetitions", repetitions}}},
                          {.rows = 20'000, .of = "n = 16, in " + dimensions(d)});
  const bool product = integrand == BoxIntegrand::product;
  const double volume = box_volume(d);
  const Theory theory =
      product ? theory_of_mean(product_moments(d), n, volume) : squares_theory(d, n);
  Suspects suspects{{theory.mean / volume, volume_missing}, of_whole_division(n)};
  add_sums_of_sides(suspects, theory.mean / volume, sum_of_box_sides(d), d);
  for (std::size_t i = 0; i < static_cast<std::size_t>(d) && d > 1; ++i) {
    suspects.push_back({theory.mean / volume * (upper(i) - lower(i)), one_side});
  }
  if (product && d > 1) suspects.push_back({volume * diagonal_product(d), same_number});
  judge(mean_is("the integral in " + dimensions(d), rows.values, theory, suspects));
  judge(variance_is("the variance of the estimates in " + dimensions(d), rows.values, theory));
}

void judge_box_record(int d) {
  constexpr std::size_t n = 4096, head = 6;
  const auto dimension = static_cast<std::size_t>(d);
  const Answer rows =
      probe("Lab 1.6 record", {.n = n, .numbers = {{"d", d}, {"integrand", 1}}},
            {.rows = head + n * dimension, .finite = false, .of = "in " + dimensions(d)});
  const Points points{dimension, {rows.values.begin() + head, rows.values.end()}};
  std::vector<double> lowest, highest;
  for (std::size_t i = 0; i < dimension; ++i) {
    lowest.push_back(lower(i));
    highest.push_back(upper(i));
  }
  judge(equals("the number of evaluations of f", rows.values[1], n, 0));
  if (rows.values[1] < n) return;  // missing points would be reported as wrong ones
  const double astray = points.outside(lowest, highest);
  judge(holds("evaluations outside the box", astray == 0, fmt::format("{}", astray), "none",
              {outside_box}));
  const Drawing of = drawing(rows, 2);
  judge(made_of("where the points lie in the box", points.shares(lowest, highest), of.before));
  long double sum = 0;
  for (std::size_t i = 0; i < n; ++i)
    sum += evaluate(BoxIntegrand::squares, points.at(i));
  const auto mean = static_cast<double>(sum / n);
  const double expected = box_volume(d) * mean;
  Suspects suspects{{mean, volume_missing}, of_whole_division(n)};
  add_sums_of_sides(suspects, mean, sum_of_box_sides(d), d);
  judge(equals("the estimate against the values of f at its points", rows.values[0], expected,
               1e-12 * expected, suspects));
  judge(draws(of.before, of.next, static_cast<double>(n * dimension)));
}

}  // namespace

TEST_CASE("Lab 1.6: f is evaluated n times within the box and its values are averaged",
          "[lab01][ex6]") {
  for (const int d : {1, 3, 10})
    judge_box_record(d);
}

// The largest cv is .67 (the product in five dimensions): 320 000 evaluations detect a bias of 1.1
// %.
TEST_CASE("Lab 1.6: the integral over a box is unbiased and its variance falls as 1/n",
          "[lab01][ex6]") {
  for (const int d : {1, 2, 3, 5})
    judge_box(BoxIntegrand::product, d);
  for (const int d : {2, 10})
    judge_box(BoxIntegrand::squares, d);
}
