// Checks of exercise 5.6; sizes and power as in checks_tables.cpp.

#include "05_inversion_rejection/inputs.h"
#include "05_inversion_rejection/match.h"
#include "05_inversion_rejection/refusal.h"
#include "05_inversion_rejection/tables.h"
#include "grader/judge/judge.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

using namespace carlo::grader;
using namespace lab05_tests;

namespace {

const Diagnosis transposed{"rows-and-columns-swapped",
                           "weights[j width + i] is column i of row j; u_row and y go with j."};
const Diagnosis rows_only{"rows-drawn-uniformly",
                          "the row has to be drawn by the sums of the rows, not with equal "
                          "probability."};
const Diagnosis columns_by_first{"one-column-table-for-all-rows",
                                 "the column is drawn without a look at the row: each row has "
                                 "column probabilities of its own."};

/// The inverse that Lab 5.6 asks for, in the words of its docstring.
struct GridInverse {
  explicit GridInverse(const Grid& grid_) : grid(grid_) {
    std::vector<double> sums;
    for (std::size_t j = 0; j < grid.height; ++j) {
      const auto first = grid.weights.begin() + static_cast<std::ptrdiff_t>(j * grid.width);
      const std::vector<double> row(first, first + static_cast<std::ptrdiff_t>(grid.width));
      columns.push_back(exact_cdf(row));
      double sum = 0;
      for (const double weight : row)
        sum += weight;
      sums.push_back(sum);
      total += sum;
    }
    rows = exact_cdf(sums);
  }
  double y(double u) const {
    const Place place = place_of(u, rows);
    return (place.index + place.fraction) / number(grid.height);
  }
  double x(double u_row, double u_column) const {
    const auto j = static_cast<std::size_t>(place_of(u_row, rows).index);
    const Place place = place_of(u_column, columns[j]);
    return (place.index + place.fraction) / number(grid.width);
  }
  double density(std::size_t i, std::size_t j) const {
    return grid.at(i, j) / total * number(grid.width * grid.height);
  }

  Grid grid;
  double total = 0;
  std::vector<double> rows;
  std::vector<std::vector<double>> columns;
};

const char* name_of(int smooth) {
  return smooth == 1 ? "16 x 12 smooth cells" : "3 x 4 cells, a row and a column empty";
}

}  // namespace

// The first number alone decides y, for every value of the second, and x is the inverse within the
// row.
TEST_CASE("Lab 5.6: u_row decides the row, u_column the place in it", "[lab05][ex6]") {
  for (const int smooth : {0, 1}) {
    const GridInverse exact(smooth == 1 ? smooth_grid() : small_grid());
    const std::vector<double> u = hard_numbers();
    const Rows rows = probe("Lab 5.6 inverse", {.numbers = {{"smooth", smooth}}},
                            {.rows = u.size() * u.size(), .columns = 3, .of = name_of(smooth)});
    double wrong_x = 0, wrong_y = 0, empty = 0, swapped = 0, uniform = 0, u_again = 0,
           first_row = 0;
    double judged = 0;
    std::size_t at = 0;
    for (const double u_row : u) {
      const double y = exact.y(u_row);
      for (const double u_column : u) {
        const double mx = rows.at(at, 0), my = rows.at(at, 1);
        empty += rows.at(at, 2) > 0 ? 0 : 1;
        ++at;
        const auto j = static_cast<std::size_t>(place_of(u_row, exact.rows).index);
        if (near_edge(u_row, exact.rows) || near_edge(u_column, exact.columns[j])) continue;
        judged += 1;
        wrong_y += std::abs(my - y) <= 1e-11 ? 0 : 1;
        wrong_x += std::abs(mx - exact.x(u_row, u_column)) <= 1e-9 ? 0 : 1;
        swapped += std::abs(my - exact.y(u_column)) <= 1e-11 ? 1 : 0;
        uniform += std::abs(my - u_row) <= 1e-11 ? 1 : 0;
        const double reused = (number(j) + u_row) / number(exact.grid.height);
        u_again += std::abs(my - reused) <= 1e-11 ? 1 : 0;
        const Place place = place_of(u_column, exact.columns[0]);
        const double by_first = (place.index + place.fraction) / number(exact.grid.width);
        first_row += std::abs(mx - by_first) <= 1e-9 ? 1 : 0;
      }
    }
    std::vector<Diagnosis> y_diagnoses, x_diagnoses;
    if (swapped >= 0.9 * judged) y_diagnoses.push_back(transposed);
    if (uniform >= 0.9 * judged) y_diagnoses.push_back(rows_only);
    if (u_again >= 0.9 * judged) y_diagnoses.push_back(spent);
    if (y_diagnoses.empty()) y_diagnoses.push_back(transposed);
    if (first_row >= 0.9 * judged) x_diagnoses.push_back(columns_by_first);
    const char* name = smooth == 1 ? "16 x 12 cells" : "3 x 4 cells, one row 0";
    judge(holds(fmt::format("values of y that are not as u_row says, {}", name), wrong_y == 0,
                fmt::format("{:g} of {:g}", wrong_y, judged), "none", y_diagnoses));
    judge(holds(fmt::format("values of x that are not as u_column says, {}", name), wrong_x == 0,
                fmt::format("{:g} of {:g}", wrong_x, judged), "none", x_diagnoses));
    judge(holds(fmt::format("samples whose density is 0, {}", name), empty == 0,
                fmt::format("{:g} of {}", empty, u.size() * u.size()), "none", {slips}));
  }
}

TEST_CASE("Lab 5.6: the density is that of each cell, and 0 outside the square", "[lab05][ex6]") {
  for (const int smooth : {0, 1}) {
    const GridInverse exact(smooth == 1 ? smooth_grid() : small_grid());
    const Grid& grid = exact.grid;
    std::vector<double> expected, transposed_density;
    for (std::size_t j = 0; j < grid.height; ++j) {
      for (std::size_t i = 0; i < grid.width; ++i)
        expected.push_back(exact.density(i, j));
    }
    Rows rows = probe("Lab 5.6 density", {.numbers = {{"smooth", smooth}}},
                      {.rows = expected.size() + 4, .of = name_of(smooth)});
    const std::vector<double> outside(rows.values.end() - 4, rows.values.end());
    rows.values.resize(expected.size());
    const double cells = number(expected.size());
    const bool unscaled =
        std::equal(expected.begin(), expected.end(), rows.values.begin(),
                   [=](double a, double b) { return std::abs(a / cells - b) <= 1e-12; });
    judge(all_equal("the density in each cell", rows.values, expected, 1e-11,
                    unscaled ? std::vector{no_width} : std::vector<Diagnosis>{}));
    judge(
        all_equal("the density outside the unit square", outside, std::vector<double>(4, 0.0), 0));
  }
}

// 4000 x 2500 cells: the samples are the numbers themselves.
TEST_CASE("Lab 5.6: ten million cells", "[lab05][ex6]") {
  const std::vector<double> u = hard_numbers();
  const Rows rows = probe("Lab 5.6 many cells", {.numbers = {{"width", 4000}, {"height", 2500}}},
                          {.rows = u.size(), .columns = 3, .of = "4000 x 2500 equal cells"});
  judge(equals_everywhere(
      "y from 1e7 equal cells", u, column(rows, 1), [](double v) { return v; }, 0, 1e-8));
  judge(equals_everywhere(
      "x from 1e7 equal cells, u_column = 1 - u_row", u, column(rows, 0),
      [](double v) { return last_below_one - v; }, 0, 1e-8));
  judge(all_equal("their density", column(rows, 2), std::vector<double>(u.size(), 1.0), 1e-8));
}

TEST_CASE("Lab 5.6: bad tables are refused", "[lab05][ex6]") {
  for (int kind = 0; kind < bad_cell_kinds; ++kind)
    judge_refusal("Lab 5.6 refusal", bad_cells_name(kind), kind);
}

TEST_CASE("Lab 5.6: samples fill every cell by its integral", "[lab05][ex6]") {
  constexpr std::size_t n = 400'000;
  const GridInverse exact(smooth_grid());
  const Grid& grid = exact.grid;
  const Rows rows = probe("Lab 5.6 samples", {.n = n, .numbers = {{"smooth", 1}}},
                          {.rows = n, .columns = 2, .of = name_of(1)});
  std::vector<double> counts(grid.weights.size()), mass;
  for (const double weight : grid.weights)
    mass.push_back(weight / exact.total);
  for (std::size_t k = 0; k < n; ++k) {
    const double x = rows.at(k, 0), y = rows.at(k, 1);
    if (!(x >= 0 && x < 1 && y >= 0 && y < 1)) continue;
    const auto i = static_cast<std::size_t>(x * number(grid.width));
    const auto j = static_cast<std::size_t>(y * number(grid.height));
    counts[j * grid.width + i] += 1;
  }
  Verdict verdict = counts_are("how many points fall into each cell", counts, mass, n);
  if (!verdict.passed) {
    std::vector<double> right;
    for (const double m : mass)
      right.push_back(m * n);
    verdict.figure = cells_figure("x, 0 to 1", "y, 0 to 1 downwards", grid.width, counts, right);
  }
  judge(verdict);
}
