// Checks of exercise 5.6; sizes and power as in checks_tables.cpp.

#include "05_inversion_rejection/inputs.h"
#include "05_inversion_rejection/match.h"
#include "05_inversion_rejection/refusal.h"
#include "05_inversion_rejection/tables.h"
#include "grader/judge/judge.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

using namespace carlo::grader;
using namespace lab05_tests;

namespace {

const Diagnosis transposed{"rows-and-columns-swapped",
                           "weights[j width + i] is column i of row j; u_row and y belong to j."};
const Diagnosis rows_only{"rows-drawn-uniformly",
                          "the row has to be drawn by the sums of the rows, not with equal "
                          "probability."};
const Diagnosis columns_by_first{"one-column-table-for-all-rows",
                                 "the column is drawn independently of the row: each row has its "
                                 "own column probabilities."};

const Diagnosis columns_only{"columns-drawn-uniformly",
                             "the column has to be drawn by the weights in its row, not with equal "
                             "probability."};
const Diagnosis x_for_y{"x-and-y-swapped",
                        "x and y are exchanged: x runs along the columns, y along the rows."};

const Diagnosis one_width{"density-over-one-width",
                          "the probability of the cell is divided by its width or its height; its "
                          "area is their product."};

/// The inverse of Lab 5.6, exactly as in its docstring.
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
  /// At the middle of each cell, row by row.
  std::vector<double> densities() const {
    std::vector<double> all;
    for (std::size_t j = 0; j < grid.height; ++j) {
      for (std::size_t i = 0; i < grid.width; ++i)
        all.push_back(density(i, j));
    }
    return all;
  }
  /// The same with x and y exchanged.
  std::vector<double> exchanged_densities() const {
    std::vector<double> all;
    for (std::size_t j = 0; j < grid.height; ++j) {
      for (std::size_t i = 0; i < grid.width; ++i) {
        // The middle of cell i of `width` lies in this cell of `height`, and vice versa.
        const std::size_t row = (2 * i + 1) * grid.height / (2 * grid.width);
        const std::size_t column = (2 * j + 1) * grid.width / (2 * grid.height);
        all.push_back(density(column, row));
      }
    }
    return all;
  }

  Grid grid;
  double total = 0;
  std::vector<double> rows;
  std::vector<std::vector<double>> columns;
};

/// The same weights, read column by column.
Grid read_by_columns(const Grid& grid) {
  Grid read = grid;
  for (std::size_t j = 0; j < grid.height; ++j) {
    for (std::size_t i = 0; i < grid.width; ++i)
      read.weights[j * grid.width + i] = grid.weights[i * grid.height + j];
  }
  return read;
}

/// The number of wrong points, and of those that match a mistake.
struct GridCounts {
  double judged = 0, wrong_x = 0, wrong_y = 0, empty = 0;
  double u_exchanged = 0, misread = 0, rows_uniform = 0, u_again = 0, exchanged = 0;
  double first_row = 0, columns_uniform = 0;

  void add(const GridInverse& exact, const GridInverse& by_columns, std::array<double, 2> p,
           double u_row, double u_column) {
    const auto [x, y] = p;
    const Place row = place_of(u_row, exact.rows);
    const Place in_first = place_of(u_column, exact.columns[0]);
    const double right_x = exact.x(u_row, u_column), right_y = exact.y(u_row);
    const auto one = [](bool yes) { return yes ? 1.0 : 0.0; };
    const auto near = [](double a, double b) { return std::abs(a - b) <= 1e-9; };
    const std::size_t j = static_cast<std::size_t>(row.index);
    const Place cell = place_of(u_column, exact.columns[j]);
    // In a rare share the remainder of u has fewer digits.
    const auto slack = [](const Place& place, const std::vector<double>& cdf) {
      return 1e-15 / (cdf[static_cast<std::size_t>(place.index)] - place.before);
    };
    judged += 1;
    wrong_y += one(!(std::abs(y - right_y) <= 1e-11 + slack(row, exact.rows)));
    wrong_x += one(!(std::abs(x - right_x) <= 1e-9 + slack(cell, exact.columns[j])));
    exchanged += one(near(x, right_y) && near(y, right_x));
    u_exchanged += one(near(y, exact.y(u_column)));
    misread += one(near(y, by_columns.y(u_row)));
    rows_uniform += one(near(y, u_row));
    u_again += one(near(y, (row.index + u_row) / number(exact.grid.height)));
    first_row += one(near(x, (in_first.index + in_first.fraction) / number(exact.grid.width)));
    columns_uniform += one(near(x, u_column));
  }
  /// Nearly all: where rounding of u decides, a point may lie anywhere.
  bool most(double count) const { return count >= 0.9 * judged; }

  std::vector<Diagnosis> signs_of_y() const {
    if (most(exchanged)) return {x_for_y};
    std::vector<Diagnosis> signs;
    if (most(u_exchanged) || most(misread)) signs.push_back(transposed);
    if (most(rows_uniform)) signs.push_back(rows_only);
    if (most(u_again)) signs.push_back(spent);
    return signs;
  }
  std::vector<Diagnosis> signs_of_x() const {
    if (most(exchanged)) return {x_for_y};
    if (most(columns_uniform)) return {columns_only};
    return most(first_row) ? std::vector{columns_by_first} : std::vector<Diagnosis>{};
  }
};

bool are_near(const std::vector<double>& found, const std::vector<double>& other) {
  return std::equal(found.begin(), found.end(), other.begin(), other.end(),
                    [](double a, double b) { return std::abs(a - b) <= 1e-9 * (1 + b); });
}

const char* name_of(GridKind kind) {
  constexpr std::array names{"3 x 4 cells, a row and a column empty", "16 x 12 smooth cells",
                             "4 x 3 cells, one of 1e9 times the others"};
  return names.at(static_cast<std::size_t>(kind));
}

Params params_of(GridKind kind) {
  return {.numbers = {{"grid", static_cast<double>(kind)}}};
}

}  // namespace

// The first number alone decides y, for every value of the second, and x is the inverse within the
// row.
TEST_CASE("Lab 5.6: u_row decides the row, u_column the place in it", "[lab05][ex6]") {
  for (const GridKind kind : {GridKind::small, GridKind::smooth, GridKind::sun}) {
    const GridInverse exact(grid_of(kind));
    const GridInverse by_columns(read_by_columns(exact.grid));
    const std::vector<double> u = numbers_for(exact.grid);
    const Rows rows = probe("Lab 5.6 inverse", params_of(kind),
                            {.rows = u.size() * u.size(), .columns = 3, .of = name_of(kind)});
    GridCounts counts;
    bool all_at_edges = true;
    for (std::size_t at = 0; at < rows.count(); ++at) {
      const double u_row = u[at / u.size()], u_column = u[at % u.size()];
      const auto j = static_cast<std::size_t>(place_of(u_row, exact.rows).index);
      if (!(rows.at(at, 2) > 0)) {
        counts.empty += 1;
        all_at_edges =
            all_at_edges && (at_edge(u_row, exact.rows) || at_edge(u_column, exact.columns[j]));
      }
      if (near_edge(u_row, exact.rows) || near_edge(u_column, exact.columns[j])) continue;
      counts.add(exact, by_columns, {rows.at(at, 0), rows.at(at, 1)}, u_row, u_column);
    }
    const char* name = name_of(kind);
    judge(holds(fmt::format("values of y that are not as u_row says, {}", name),
                counts.wrong_y == 0, fmt::format("{:g} of {:g}", counts.wrong_y, counts.judged),
                "none", counts.signs_of_y()));
    judge(holds(fmt::format("values of x that are not as u_column says, {}", name),
                counts.wrong_x == 0, fmt::format("{:g} of {:g}", counts.wrong_x, counts.judged),
                "none", counts.signs_of_x()));
    judge(holds(fmt::format("samples whose density is 0, {}", name), counts.empty == 0,
                fmt::format("{:g} of {}", counts.empty, rows.count()), "none",
                all_at_edges ? std::vector{slips} : std::vector<Diagnosis>{}));
  }
}

TEST_CASE("Lab 5.6: the density is that of each cell, and 0 outside the square", "[lab05][ex6]") {
  for (const GridKind kind : {GridKind::small, GridKind::smooth, GridKind::sun}) {
    const GridInverse exact(grid_of(kind));
    const std::vector<double> expected = exact.densities(), exchanged = exact.exchanged_densities();
    Rows rows = probe("Lab 5.6 density", params_of(kind),
                      {.rows = expected.size() + 4, .of = name_of(kind)});
    const std::vector<double> outside(rows.values.end() - 4, rows.values.end());
    rows.values.resize(expected.size());
    const auto divided_by = [&](double count) {
      return std::equal(expected.begin(), expected.end(), rows.values.begin(),
                        [=](double a, double b) { return std::abs(a / count - b) <= 1e-12; });
    };
    std::vector<Diagnosis> diagnoses;
    if (divided_by(number(expected.size()))) diagnoses.push_back(no_width);
    if (divided_by(number(exact.grid.width)) || divided_by(number(exact.grid.height))) {
      diagnoses.push_back(one_width);
    }
    if (are_near(rows.values, exchanged)) diagnoses.push_back(x_for_y);
    judge(all_equal("the density in each cell", rows.values, expected, 1e-11, diagnoses));
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

// A submission that draws with weights other than the given ones may not have seen the bad ones.
TEST_CASE("Lab 5.6: bad tables are refused", "[lab05][ex6]") {
  const std::vector<double> expected = GridInverse(small_grid()).densities();
  const Rows good =
      probe("Lab 5.6 density", params_of(GridKind::small),
            {.rows = expected.size() + 4, .finite = false, .of = name_of(GridKind::small)});
  const bool weights_seen = are_near({good.values.begin(), good.values.end() - 4}, expected);
  for (int kind = 0; kind < bad_cell_kinds; ++kind)
    judge_refusal("Lab 5.6 refusal", bad_cells_name(kind), kind, weights_seen);
}

TEST_CASE("Lab 5.6: samples fill every cell by its integral", "[lab05][ex6]") {
  constexpr std::size_t n = 400'000;
  const GridInverse exact(smooth_grid());
  const Grid& grid = exact.grid;
  const Rows rows =
      probe("Lab 5.6 samples", {.n = n, .numbers = params_of(GridKind::smooth).numbers},
            {.rows = n, .columns = 2, .of = name_of(GridKind::smooth)});
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
