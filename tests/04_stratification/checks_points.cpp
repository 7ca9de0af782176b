// Checks of exercises 4.3 and 4.4.

#include "04_stratification/slips.h"
#include "04_stratification/theory.h"
#include "grader/judge/judge.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>

using namespace carlo::grader;
using namespace lab04_tests;

namespace {

const Diagnosis swapped{"columns-and-rows-swapped",
                        "points lie in the cells of a grid with columns and rows exchanged, or in "
                        "another order: x belongs to the column, which runs fastest."};
const Diagnosis not_in_cell{"points-not-in-their-cells", "points lie outside their cells."};
const Diagnosis whole_cells{"whole-number-division",
                            "all points lie in the first cell: column/columns of two whole "
                            "numbers is a whole number, 0."};
const Diagnosis axis_by_axis{"coordinates-axis-by-axis",
                             "the coordinates are stored axis by axis; those of one point belong "
                             "together, coordinate k of point j at [j * dimensions + k]."};
const Diagnosis no_jitter_in_cells{"no-jitter", "all points lie at the same place of their cells."};
const Diagnosis same_number{"same-number-for-x-and-y",
                            "x and y come from one random number: the points lie on the diagonals "
                            "of their cells."};

const Diagnosis axis_not_stratified{"axis-not-stratified",
                                    "along an axis, some strata hold no point and others several."};
const Diagnosis whole_strata{"whole-number-division",
                             "all points lie in the first stratum of every axis: a quotient of two "
                             "whole numbers is a whole number, 0."};
const Diagnosis in_order{"axis-in-order",
                         "on an axis the strata are assigned in order, not shuffled."};
const Diagnosis same_order{"same-permutation-on-every-axis",
                           "all axes share one permutation: the points lie along the diagonal."};
const Diagnosis biased_shuffle{"biased-shuffle",
                               "some orders are more likely than others: swap place j with one of "
                               "the places 0 ... j, each equally likely, j included."};

struct Grid {
  std::size_t columns, rows;
};

Rows jittered(const Grid& grid) {
  return probe("Lab 4.3 points",
               {.numbers = {{"columns", static_cast<double>(grid.columns)},
                            {"rows", static_cast<double>(grid.rows)}}},
               {.rows = grid.columns * grid.rows + 1, .columns = 2, .finite = false});
}

/// The number of whole rows of cells (or columns) before cell i.
std::size_t lines_before(std::size_t i, std::size_t length) {
  return i / length;
}

/// The relative positions of points in their cells: in [0, 1)^2 for points inside them.
struct Within {
  std::vector<double> x, y;
};

Within within_cells(const Rows& rows, const Grid& grid) {
  Within within;
  for (std::size_t i = 0; i + 1 < rows.count(); ++i) {
    within.x.push_back(rows.at(i + 1, 0) * static_cast<double>(grid.columns) -
                       static_cast<double>(i % grid.columns));
    within.y.push_back(rows.at(i + 1, 1) * static_cast<double>(grid.rows) -
                       static_cast<double>(lines_before(i, grid.columns)));
  }
  return within;
}

bool in_cell(double x, double y) {
  return x >= 0 && x < 1 && y >= 0 && y < 1;
}

/// True if a point is at 1 or above, on either axis.
bool lies_beyond_one(const Rows& points) {
  for (std::size_t i = 1; i < points.count(); ++i) {
    if (points.at(i, 0) >= 1 || points.at(i, 1) >= 1) return true;
  }
  return false;
}

/// True if all points are where they would be with the loops, or the two sides, exchanged.
bool is_exchanged(const Rows& points, const Grid& grid) {
  const auto columns = static_cast<double>(grid.columns), rows = static_cast<double>(grid.rows);
  bool other_order = true, other_sides = true;
  for (std::size_t i = 0; i + 1 < points.count(); ++i) {
    const double x = points.at(i + 1, 0), y = points.at(i + 1, 1);
    other_order =
        other_order && in_cell(x * columns - static_cast<double>(lines_before(i, grid.rows)),
                               y * rows - static_cast<double>(i % grid.rows));
    other_sides =
        other_sides && in_cell(x * rows - static_cast<double>(i % grid.columns),
                               y * columns - static_cast<double>(lines_before(i, grid.columns)));
  }
  return other_order || other_sides;
}

/// True if all points lie in the first cell.
bool in_first_cell(const Rows& points, const Grid& grid) {
  for (std::size_t i = 1; i < points.count(); ++i) {
    if (!in_cell(points.at(i, 0) * static_cast<double>(grid.columns),
                 points.at(i, 1) * static_cast<double>(grid.rows))) {
      return false;
    }
  }
  return true;
}

/// True if in all points only one part of i + u was divided, in x and in y.
bool is_one_part_divided(const Rows& points, const Grid& grid) {
  const auto columns = static_cast<double>(grid.columns), rows = static_cast<double>(grid.rows);
  bool share_alone = true, number_alone = true;
  for (std::size_t i = 0; i + 1 < points.count(); ++i) {
    const double x = points.at(i + 1, 0), y = points.at(i + 1, 1);
    const auto column = static_cast<double>(i % grid.columns);
    const auto row = static_cast<double>(lines_before(i, grid.columns));
    share_alone = share_alone && is_share_divided_alone(x, column, columns) &&
                  is_share_divided_alone(y, row, rows);
    number_alone = number_alone && is_number_divided_alone(x, column, columns) &&
                   is_number_divided_alone(y, row, rows);
  }
  return share_alone || (number_alone && lies_beyond_one(points));
}

Rows hypercubes(std::size_t n, std::size_t dimensions, std::size_t repetitions) {
  return probe("Lab 4.4 hypercubes",
               {.n = static_cast<std::int64_t>(n),
                .numbers = {{"dimensions", static_cast<double>(dimensions)},
                            {"repetitions", static_cast<double>(repetitions)}}},
               {.rows = repetitions, .columns = n * dimensions + 1, .finite = false});
}

/// The strata of axis k's n coordinates in the hypercube of one row.
std::vector<int> strata_of(const Rows& rows, std::size_t row, std::size_t n, std::size_t d,
                           std::size_t k) {
  std::vector<int> strata;
  for (std::size_t j = 0; j < n; ++j) {
    const double x = rows.at(row, 1 + j * d + k);
    strata.push_back(x >= 0 && x < 1 ? static_cast<int>(x * static_cast<double>(n)) : -1);
  }
  return strata;
}

/// The number of strata, over all axes, without a point of one hypercube (`row`: its size, its
/// coordinates).
std::size_t strata_missed(const std::vector<double>& row, std::size_t n, std::size_t d) {
  const Rows rows{row.size(), row};
  std::size_t missed = 0;
  for (std::size_t k = 0; k < d; ++k) {
    std::vector<int> strata = strata_of(rows, 0, n, d, k);
    std::sort(strata.begin(), strata.end());
    for (std::size_t i = 0; i < n; ++i)
      missed += std::binary_search(strata.begin(), strata.end(), static_cast<int>(i)) ? 0 : 1;
  }
  return missed;
}

/// The intended hypercube if the coordinates are stored axis by axis.
std::vector<double> points_first(const std::vector<double>& row, std::size_t n, std::size_t d) {
  std::vector<double> out = row;
  for (std::size_t j = 0; j < n; ++j) {
    for (std::size_t k = 0; k < d; ++k)
      out[1 + j * d + k] = row[1 + k * n + j];
  }
  return out;
}

/// True if in all coordinates of one hypercube only one part of i + u was divided. i + u/n: the
/// whole parts are the strata. i/n + u: half of them lie beyond 1.
bool is_one_part_divided(const std::vector<double>& row, std::size_t n, std::size_t d) {
  const auto strata = static_cast<double>(n);
  std::vector<double> scaled{row[0]};
  double beyond = 0;
  bool below_two = true, share_alone = n > 1;
  for (std::size_t k = 1; k < row.size(); ++k) {
    scaled.push_back(std::floor(row[k]) / strata);
    share_alone = share_alone && is_share_divided_alone(row[k], std::floor(row[k]), strata);
    beyond += row[k] >= 1 ? 1 : 0;
    below_two = below_two && row[k] >= 0 && row[k] < 2;
  }
  if (share_alone && strata_missed(scaled, n, d) == 0) return true;
  return below_two && n >= 7 && beyond >= 0.2 * static_cast<double>(n * d);
}

/// The mistake that explains strata without a point.
Diagnosis sign_of_missed_strata(const std::vector<double>& row, std::size_t n, std::size_t d) {
  if (strata_missed(points_first(row, n, d), n, d) == 0) return axis_by_axis;
  if (is_one_part_divided(row, n, d)) return one_part_divided;
  const bool in_first = std::all_of(row.begin() + 1, row.end(), [n](double x) {
    return x >= 0 && x * static_cast<double>(n) < 1;
  });
  return in_first ? whole_strata : axis_not_stratified;
}

}  // namespace

TEST_CASE("Lab 4.3: each cell holds its point, in reading order", "[lab04][ex3]") {
  for (const Grid& grid : {Grid{5, 3}, Grid{1, 8}, Grid{8, 1}, Grid{64, 64}}) {
    const std::string which = fmt::format("{} columns, {} rows", grid.columns, grid.rows);
    const Rows rows = jittered(grid);
    const auto cells = static_cast<double>(grid.columns * grid.rows);
    judge(equals("the number of points, " + which, rows.at(0, 0), cells, 0));
    const Within within = within_cells(rows, grid);
    std::size_t astray = 0;
    for (std::size_t i = 0; i < within.x.size(); ++i)
      astray += in_cell(within.x[i], within.y[i]) ? 0 : 1;
    const bool exchanged = is_exchanged(rows, grid);
    judge(holds("points outside of their cell, " + which, astray == 0, fmt::format("{}", astray),
                "none",
                {exchanged                         ? swapped
                 : in_first_cell(rows, grid)       ? whole_cells
                 : is_one_part_divided(rows, grid) ? one_part_divided
                                                   : not_in_cell}));
  }
}

// 4096 positions: Kolmogorov-Smirnov detects distances of .058, the product of the two offsets a
// correlation of .14, with power .999.
TEST_CASE("Lab 4.3: within its cell a point may lie anywhere, equally likely", "[lab04][ex3]") {
  const Grid grid{64, 64};
  const Within within = within_cells(jittered(grid), grid);
  const auto [least, most] = std::minmax_element(within.x.begin(), within.x.end());
  judge(holds("the places within the cells differ", *most - *least > 0.5,
              fmt::format("x from {:.4g} to {:.4g} of a cell", *least, *most), "from 0 to 1",
              {no_jitter_in_cells}));
  judge(uniform_on("x within the cells", within.x, 0, 1));
  judge(uniform_on("y within the cells", within.y, 0, 1));
  std::vector<double> products;
  for (std::size_t i = 0; i < within.x.size(); ++i)
    products.push_back((within.x[i] - 0.5) * (within.y[i] - 0.5));
  // For points outside their cells, which another test reports, these are no offsets.
  const auto [lowest, highest] = std::minmax_element(within.y.begin(), within.y.end());
  const bool all_within = *least >= 0 && *most < 1 && *lowest >= 0 && *highest < 1;
  judge(mean_is("the mean product of the offsets in x and y", products, {0, 1.0 / 12},
                all_within ? Suspects{{1.0 / 12, same_number}} : Suspects{}));
}

// Neighbouring cells: offsets that repeat from cell to cell would show here.
TEST_CASE("Lab 4.3: the points of different cells are independent", "[lab04][ex3]") {
  const Grid grid{64, 64};
  const Within within = within_cells(jittered(grid), grid);
  std::vector<double> along, down;
  for (std::size_t i = 0; i + 64 < within.x.size(); ++i) {
    along.push_back((within.x[i] - 0.5) * (within.x[i + 1] - 0.5));
    down.push_back((within.y[i] - 0.5) * (within.y[i + 64] - 0.5));
  }
  // Products of neighbours are uncorrelated though they share a point.
  judge(mean_is("the mean product of neighbours' offsets in x", along, {0, 1.0 / 12},
                {{1.0 / 12, no_jitter_in_cells}}));
  judge(mean_is("the mean product of offsets in y of cells one above the other", down,
                {0, 1.0 / 12}, {{1.0 / 12, no_jitter_in_cells}}));
}

TEST_CASE("Lab 4.4: along every axis each stratum holds exactly one point", "[lab04][ex4]") {
  struct Size {
    std::size_t n, d;
  };
  for (const Size& size : {Size{1, 3}, Size{7, 1}, Size{64, 5}, Size{4096, 2}}) {
    const std::string which = fmt::format("{} points in {} dimensions", size.n, size.d);
    const Rows rows = hypercubes(size.n, size.d, 1);
    judge(equals("the number of coordinates, " + which, rows.at(0, 0),
                 static_cast<double>(size.n * size.d), 0));
    const std::size_t missed = strata_missed(rows.values, size.n, size.d);
    judge(holds("strata without a point, " + which, missed == 0, fmt::format("{}", missed), "none",
                {sign_of_missed_strata(rows.values, size.n, size.d)}));
  }
}

// The six orders of three strata, in 60 000 hypercubes: each frequency is detected if it is off by
// .0133 with power .999; swapping any place with any other gives 4/27 and 5/27 instead of 1/6, off
// by .0185.
TEST_CASE("Lab 4.4: all orders of the strata are equally likely and independent from axis to axis",
          "[lab04][ex4]") {
  constexpr std::size_t repetitions = 60'000;
  const Rows rows = hypercubes(3, 2, repetitions);
  bool all_orders = true;  // and no stratum twice
  const Theory sixth{1.0 / 6, std::sqrt(1.0 / 6 * 5 / 6)};
  std::vector<double> together(repetitions, 0);
  std::array<std::array<std::vector<double>, 6>, 2> is_order;
  const std::array<std::vector<int>, 6> orders{
      {{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}}};
  for (std::size_t row = 0; row < repetitions; ++row) {
    const auto first = strata_of(rows, row, 3, 2, 0), second = strata_of(rows, row, 3, 2, 1);
    together[row] = first == second ? 1 : 0;
    all_orders = all_orders && std::count(orders.begin(), orders.end(), first) == 1 &&
                 std::count(orders.begin(), orders.end(), second) == 1;
    for (std::size_t o = 0; o < 6; ++o) {
      is_order[0][o].push_back(first == orders[o] ? 1 : 0);
      is_order[1][o].push_back(second == orders[o] ? 1 : 0);
    }
  }
  judge(mean_is("how often two axes have the same order", together, sixth,
                all_orders ? Suspects{{1, same_order}} : Suspects{}));
  for (std::size_t k = 0; k < 2; ++k) {
    const auto& hits = is_order[k][0];
    const bool always = std::all_of(hits.begin(), hits.end(), [](double hit) { return hit == 1; });
    for (std::size_t o = 0; o < 6; ++o) {
      Verdict verdict =
          mean_is(fmt::format("how often axis {} has the order {}", k, fmt::join(orders[o], " ")),
                  is_order[k][o], sixth);
      if (!verdict.passed && all_orders)
        verdict.diagnoses.push_back(always ? in_order : biased_shuffle);
      judge(verdict);
    }
  }
}

// Two axes with 8192 positions each; Kolmogorov-Smirnov detects distances of .041.
TEST_CASE("Lab 4.4: within its strata a point may lie anywhere, equally likely", "[lab04][ex4]") {
  constexpr std::size_t n = 8192;
  const Rows rows = hypercubes(n, 2, 1);
  std::array<std::vector<double>, 2> within;
  for (std::size_t j = 0; j < 2 * n; ++j)
    within[j % 2].push_back(std::fmod(rows.at(0, 1 + j) * static_cast<double>(n), 1.0));
  const auto [least, most] = std::minmax_element(within[0].begin(), within[0].end());
  judge(holds("the places within the strata differ", *most - *least > 0.5,
              fmt::format("from {:.4g} to {:.4g} of a stratum", *least, *most), "from 0 to 1",
              {no_jitter_in_cells}));
  judge(uniform_on("places within the strata of axis 0", within[0], 0, 1));
  judge(uniform_on("places within the strata of axis 1", within[1], 0, 1));
}

// For x + y each axis is stratified separately: variance 2/(12 n^3), excess kurtosis -1.2/(2 n). 20
// 000 estimates detect a bias of 4e-4 and variances that are off by 8 %; that of plain points is
// 256 times as large.
TEST_CASE("Lab 4.4: sums of functions of one coordinate are estimated with a stratum's variance",
          "[lab04][ex4][variance]") {
  constexpr std::size_t n = 16, repetitions = 20'000;
  const Rows rows = hypercubes(n, 2, repetitions);
  std::vector<double> estimates;
  for (std::size_t row = 0; row < repetitions; ++row) {
    double sum = 0;
    for (std::size_t j = 0; j < 2 * n; ++j)
      sum += rows.at(row, 1 + j);
    estimates.push_back(sum / n);
  }
  const double variance = 2.0 / 12 / (n * n * n);
  const Theory theory{1, std::sqrt(variance), -1.2 / (2 * n)};
  judge(mean_is("the mean of x + y", estimates, theory));
  judge(variance_is("the variance of the estimates of x + y", estimates, theory,
                    {{2.0 / 12 / n, axis_not_stratified}, {0, no_jitter_in_cells}}));
}
