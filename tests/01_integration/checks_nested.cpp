// Checks of exercise 1.5: the midpoint rule in d dimensions, against its exact error of -h^2 / 12
// for the square of each coordinate.

#include "01_integration/dimensions.h"
#include "01_integration/drawn.h"
#include "01_integration/integrands.h"
#include "01_integration/slips.h"
#include "01_integration/theory.h"
#include "grader/judge/judge.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

using namespace carlo::grader;
using namespace lab01_tests;

namespace {

const Diagnosis one_dimension{"cell-volume-of-one-dimension",
                              "the sum is multiplied by the width of one dimension and not by "
                              "those of all."};
const Diagnosis first_side{"first-side-for-all",
                           "the cells have the first dimension's width in every dimension; each "
                           "dimension has its own."};
const Diagnosis no_volume{"missing-box-volume",
                          "the mean over the cells is not yet the integral: the box's volume is "
                          "missing."};
const Diagnosis not_scaled{"sum-not-scaled",
                           "the sum over the cells is multiplied by no cell volume."};
const Diagnosis by_n_only{
    "divided-by-n-once",
    "the sum over the n^d cells is divided by n once; every dimension has its "
    "own width h."};
const Diagnosis box_for_cell{"volume-of-box-for-cell",
                             "the sum is multiplied by the volume of the box and not by that of a "
                             "cell."};
const Diagnosis at_corners{"points-at-corners",
                           "f is evaluated at the cells' corners and not in their middle."};
const Diagnosis outside_rule_box{
    "points-outside-box",
    "f is evaluated outside the box: every dimension has its own lower and "
    "upper end."};
const Diagnosis too_few{"n-points-in-all",
                        "n points are taken in all; n in every dimension are n^d."};

Rows nested(BoxIntegrand integrand, int d, std::int64_t n) {
  return probe("Lab 1.5 nested",
               {.n = n, .numbers = {{"d", d}, {"integrand", static_cast<double>(integrand)}}},
               {.columns = 3, .of = fmt::format("in {}, n = {}", dimensions(d), n)});
}

double side(int i) {
  return upper(static_cast<std::size_t>(i)) - lower(static_cast<std::size_t>(i));
}

double volume(int d) {
  double product = 1;
  for (int i = 0; i < d; ++i)
    product *= side(i);
  return product;
}

/// The mean over the box of the two integrands; `n` > 0: according to the midpoint rule.
double box_mean(BoxIntegrand integrand, int d, double n) {
  double product = 1, squares = 0;
  for (int i = 0; i < d; ++i) {
    const auto index = static_cast<std::size_t>(i);
    const double h = n > 0 ? side(i) / n : 0;
    product *= (lower(index) + upper(index)) / 2;
    squares += (i + 1) * (power_mean(2, lower(index), upper(index)) - h * h / 12);
  }
  return integrand == BoxIntegrand::product ? product : squares;
}

/// The mean over the cells' lower (`sign` -1) or upper (1) corners.
double corner_mean(BoxIntegrand integrand, int d, double n, double sign) {
  double product = 1, squares = 0;
  for (int i = 0; i < d; ++i) {
    const auto index = static_cast<std::size_t>(i);
    const double centre = (lower(index) + upper(index)) / 2, step = sign * side(i) / n / 2;
    const double centres = power_mean(2, lower(index), upper(index)) - step * step / 3;
    product *= centre + step;
    squares += (i + 1) * (centres + 2 * step * centre + step * step);
  }
  return integrand == BoxIntegrand::product ? product : squares;
}

/// The integral if the cells are as wide in every dimension as in the first.
double with_first_side(BoxIntegrand integrand, int d, double n) {
  const double width = side(0), h = width / n;
  double product = 1, squares = 0;
  for (int i = 0; i < d; ++i) {
    const double from = lower(static_cast<std::size_t>(i));
    product *= from + width / 2;
    squares += (i + 1) * (power_mean(2, from, from + width) - h * h / 12);
  }
  return std::pow(width, d) * (integrand == BoxIntegrand::product ? product : squares);
}

/// The results of mistakes in place of `right`, where f is evaluated at n^d points.
Suspects nested_suspects(BoxIntegrand integrand, int d, int n, double right) {
  const double cells = std::pow(n, d);
  Suspects suspects{{right / volume(d), no_volume},
                    of_whole_division(n),
                    {volume(d) * corner_mean(integrand, d, n, -1), at_corners},
                    {volume(d) * corner_mean(integrand, d, n, 1), at_corners}};
  if (n > 1) {
    suspects.push_back({right / volume(d) * cells, not_scaled});
    suspects.push_back({right * cells, box_for_cell});
  }
  if (n > 1 && d > 1) suspects.push_back({right * cells / n, by_n_only});
  if (d > 1) suspects.push_back({with_first_side(integrand, d, n), first_side});
  double sides = 0;
  for (int i = 0; i < d; ++i)
    sides += side(i);
  add_sums_of_sides(suspects, right / volume(d), sides, d);
  for (int i = 0; i < d && d > 1; ++i) {
    // One width in place of all, times either the sum over n^d points or its mean.
    suspects.push_back({right / volume(d) * side(i), one_dimension});
    suspects.push_back({right / volume(d) * side(i) * std::pow(n, d - 1), one_dimension});
  }
  return suspects;
}

void judge_nested(BoxIntegrand integrand, int d, int n) {
  const Rows rows = nested(integrand, d, n);
  const double right = volume(d) * box_mean(integrand, d, n);
  const double count = std::pow(n, d);
  judge(equals(fmt::format("evaluations in {}, n = {}", dimensions(d), n), rows.at(0, 1), count, 0,
               d > 1 && n > 1 ? Suspects{{static_cast<double>(n), too_few},
                                         {static_cast<double>(n) * d, too_few}}
                              : Suspects{}));
  judge(holds("evaluations outside the box in " + dimensions(d), rows.at(0, 2) == 0,
              fmt::format("{}", rows.at(0, 2)), "none", {outside_rule_box}));
  judge(equals(fmt::format("the integral in {}, n = {}", dimensions(d), n), rows.at(0, 0), right,
               1e-12 * right,
               rows.at(0, 1) == count ? nested_suspects(integrand, d, n, right) : Suspects{}));
}

/// The sum over the midpoints of n^d cells, each computed from the digits of its number.
double wave_sum(const DrawnWave& wave, int n) {
  const std::size_t d = wave.lower.size();
  const auto cells = static_cast<std::int64_t>(std::pow(n, d));
  double cell_volume = 1, sum = 0;
  for (std::size_t i = 0; i < d; ++i)
    cell_volume *= (wave.upper[i] - wave.lower[i]) / n;
  std::vector<double> x(d);
  for (std::int64_t cell = 0; cell < cells; ++cell) {
    std::int64_t digits = cell;
    for (std::size_t i = 0; i < d; ++i, digits /= n) {
      const double place = (static_cast<double>(digits % n) + 0.5) / n;
      x[i] = wave.lower[i] + (wave.upper[i] - wave.lower[i]) * place;
    }
    sum += wave(x);
  }
  return cell_volume * sum;
}

void judge_nested_wave(int d, int n) {
  const std::string what = fmt::format("a random wave in {}, n = {}", dimensions(d), n);
  const Answer rows = probe("Lab 1.5 drawn wave", {.n = n, .numbers = {{"d", d}}}, {.of = what});
  const double right = wave_sum(drawn_wave(rows.seed, static_cast<std::size_t>(d)), n);
  judge(equals("the integral of " + what, rows.at(0, 0), right, 1e-11 * right));
}

}  // namespace

TEST_CASE("Lab 1.5: the nested rule is exact for functions linear in each coordinate",
          "[lab01][ex5]") {
  for (const int d : {1, 2, 3, 5}) {
    for (const int n : {1, 4})
      judge_nested(BoxIntegrand::product, d, n);
  }
}

TEST_CASE("Lab 1.5: the nested rule has its known error for squares, in each dimension its own",
          "[lab01][ex5]") {
  for (const int d : {1, 2, 3, 5})
    judge_nested(BoxIntegrand::squares, d, 3);
}

TEST_CASE("Lab 1.5: functions and boxes that nobody knows by heart", "[lab01][ex5]") {
  judge_nested_wave(1, 6);
  judge_nested_wave(2, 5);
  judge_nested_wave(4, 3);
}
