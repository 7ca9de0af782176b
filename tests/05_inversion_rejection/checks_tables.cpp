// Checks of exercises 5.4 to 5.6. Nearly all are exact: a table's inverse CDF is known. A
// chi-square test of 400 000 samples in 250 cells catches cells that are off by 4 % (rms):
// noncentrality 640, power .999 needs 290.

#include "05_inversion_rejection/inputs.h"
#include "05_inversion_rejection/match.h"
#include "05_inversion_rejection/refusal.h"
#include "grader/judge/judge.h"

#include <algorithm>
#include <array>
#include <cmath>

using namespace carlo::grader;
using namespace lab05_tests;

namespace {

const Diagnosis zero_drawn{"weight-0-drawn",
                           "a number of weight 0 is drawn: search for the first CDF entry above u, "
                           "not for one that is at least u; and trailing zeros keep the last sum."};
const Diagnosis edge_to_lower{"edge-goes-to-the-lower-number",
                              "a u that equals a CDF entry belongs to the next number: search for "
                              "the first entry above u, not for one that is at least u."};
const Diagnosis float_cdf{"cdf-in-float", "millions of sums in float drift: add up in double."};
const Diagnosis fraction_of_one{"fraction-reaches-one",
                                "both differences of (u - C_(i-1))/(C_i - C_(i-1)) are rounded, "
                                "and now and then they are equal "
                                "though u is below C_i: keep the fraction below 1."};
const Diagnosis spent{"u-used-twice",
                      "u has been spent on the choice: what is left of it is its place between the "
                      "two CDF entries, not u itself."};
const Diagnosis not_stretched{"remainder-not-stretched",
                              "u minus the CDF entry before it still has to be divided by the "
                              "number's share."};
const Diagnosis accepts_nonsense{"bad-weights-accepted",
                                 "weights that are no probabilities have to be refused with "
                                 "carlo::Error."};
const Diagnosis no_width{"probability-for-density",
                         "this is the probability of a bin or cell; its density is the probability "
                         "divided by its width or area."};
const Diagnosis cumulative{"cdf-for-probability",
                           "this is the CDF's entry; the probability is its distance from the one "
                           "before."};
const Diagnosis slips{"slips-into-the-neighbour",
                      "rounding carries some x over the edge into a bin of density 0: place and "
                      "look up bins with the functions of bins.h."};
const Diagnosis at_the_edge{"samples-at-bin-edges",
                            "all samples of a bin fall on its edge or centre: what is left of u "
                            "places them within."};
const Diagnosis transposed{"rows-and-columns-swapped",
                           "weights[j width + i] is column i of row j; u_row and y go with j."};
const Diagnosis rows_only{"rows-drawn-uniformly",
                          "the row has to be drawn by the sums of the rows, not with equal "
                          "probability."};
const Diagnosis columns_by_first{"one-column-table-for-all-rows",
                                 "the column is drawn without a look at the row: each row has "
                                 "column probabilities of its own."};

double number(std::size_t i) {
  return static_cast<double>(i);
}

Params params_of(Weights kind) {
  return {.numbers = {{"weights", static_cast<double>(kind)}}};
}

/// Where u belongs in a table of weights.
struct Place {
  double index, fraction, before;
};
Place place_of(double u, const std::vector<double>& cdf) {
  const auto i =
      static_cast<std::size_t>(std::upper_bound(cdf.begin(), cdf.end(), u) - cdf.begin());
  const double before = i == 0 ? 0 : cdf[i - 1];
  return {number(i), (u - before) / (cdf[i] - before), before};
}

const char* name_of(Weights kind) {
  constexpr std::array names{"the weights 1 2 3 2",
                             "the weights 0 0 1 0 2 0 0 1 0",
                             "a single weight",
                             "the weights 1e-310 0 3e-310",
                             "300 rugged weights",
                             "131072 weights, every second 0",
                             "six equal weights and two zeros",
                             "the weights 8e-17 1.168 0.183"};
  return names.at(static_cast<std::size_t>(kind));
}

/// Edges of the CDF are compared only where they are exact in double.
bool exact_edges(Weights kind) {
  return kind == Weights::eighths || kind == Weights::gaps || kind == Weights::comb ||
         kind == Weights::one;
}

/// Whether u is too near an edge for rounding to decide.
bool near_edge(double u, const std::vector<double>& cdf) {
  const auto above = std::lower_bound(cdf.begin(), cdf.end(), u - 1e-12);
  return above != cdf.end() && std::abs(*above - u) <= 1e-12 && u < 1 - 1e-12;
}

void judge_picks(Weights kind) {
  const std::vector<double> weights = weights_of(kind), cdf = exact_cdf(weights);
  const std::vector<double> u = numbers_for(weights);
  const Rows rows =
      probe("Lab 5.4 picks", params_of(kind), {.rows = u.size(), .columns = 2, .finite = false});
  const std::string name = name_of(kind);
  double worst = 0;
  bool below_one = true, all_spent = true, all_raw = true;
  for (std::size_t i = 0; i < u.size(); ++i) {
    const Place place = place_of(u[i], cdf);
    const double index = rows.at(i, 0), fraction = rows.at(i, 1);
    const bool valid = index >= 0 && index < number(weights.size()) && std::floor(index) == index;
    if (!valid || weights[static_cast<std::size_t>(index)] == 0) {
      judge(holds(fmt::format("the number drawn from {} with u = {:.17g}", name, u[i]), false,
                  fmt::format("{:g}", index), fmt::format("{:g}", place.index),
                  valid ? std::vector{zero_drawn} : std::vector<Diagnosis>{}));
      return;
    }
    below_one = below_one && fraction >= 0 && fraction < 1;
    if (!exact_edges(kind) && near_edge(u[i], cdf)) continue;
    if (index != place.index) {
      const bool at_edge = u[i] == cdf[static_cast<std::size_t>(index)];
      judge(holds(fmt::format("the number drawn from {} with u = {:.17g}", name, u[i]), false,
                  fmt::format("{:g}", index), fmt::format("{:g}", place.index),
                  at_edge ? std::vector{edge_to_lower} : std::vector<Diagnosis>{}));
      return;
    }
    const double slack = 1e-9 + 1e-15 / (cdf[static_cast<std::size_t>(index)] - place.before);
    const double distance = std::abs(fraction - place.fraction);
    worst = std::max(worst, distance <= slack ? 0 : std::isnan(distance) ? 1 : distance);
    all_spent = all_spent && fraction == u[i];
    all_raw = all_raw && std::abs(fraction - (u[i] - place.before)) <= 1e-15;
  }
  judge(holds("the numbers drawn from " + name, true, "right", "right"));
  judge(holds("fractions of " + name, below_one,
              below_one ? "all in [0, 1)" : "some outside [0, 1)", "all in [0, 1)",
              {fraction_of_one}));
  Verdict verdict = equals("the largest error of a fraction, " + name, worst, 0, 0);
  if (!verdict.passed && all_spent) verdict.diagnoses.push_back(spent);
  if (!verdict.passed && all_raw) verdict.diagnoses.push_back(not_stretched);
  judge(verdict);
}

std::vector<double> probabilities(const std::vector<double>& weights) {
  long double sum = 0;
  for (const double weight : weights)
    sum += weight;
  std::vector<double> result;
  result.reserve(weights.size());
  for (const double weight : weights)
    result.push_back(static_cast<double>(weight / sum));
  return result;
}

void judge_refusal(const char* probe_name, const char* name, int kind) {
  const Rows rows = probe(probe_name, {.numbers = {{"kind", kind}}}, {});
  const double answer = rows.at(0, 0);
  judge(is_so(name, answer == 1, answer == 0 ? "accepted" : "an exception of another kind",
              "carlo::Error", {accepts_nonsense}));
}

}  // namespace

TEST_CASE("Lab 5.4: the number drawn is where u falls, and weight 0 is never drawn",
          "[lab05][ex4]") {
  for (int kind = 0; kind < static_cast<int>(Weights::count); ++kind)
    judge_picks(static_cast<Weights>(kind));
}

TEST_CASE("Lab 5.4: probabilities are the weights' shares", "[lab05][ex4]") {
  for (const Weights kind : {Weights::eighths, Weights::gaps, Weights::rugged, Weights::tiny}) {
    const std::vector<double> expected = probabilities(weights_of(kind));
    const Rows rows =
        probe("Lab 5.4 probabilities", params_of(kind), {.rows = expected.size(), .finite = false});
    const std::vector<double> cdf = exact_cdf(weights_of(kind));
    const bool sums = std::equal(cdf.begin(), cdf.end(), rows.values.begin(),
                                 [](double a, double b) { return std::abs(a - b) <= 1e-9; });
    judge(all_equal(fmt::format("the probabilities of {}", name_of(kind)), rows.values, expected,
                    1e-14, sums ? std::vector{cumulative} : std::vector<Diagnosis>{}));
  }
}

// The sums' rounding may shift an edge by 1e-9 at worst, 0.01 of a share; in float the last sum of
// 1e7 weights of 0.1 is 1087937, not 1000000.
TEST_CASE("Lab 5.4: ten million weights keep their probabilities", "[lab05][ex4]") {
  constexpr std::int64_t n = 10'000'000, stride = 9973;
  constexpr std::size_t count = (n + stride - 1) / stride + 1;
  const Rows rows = probe("Lab 5.4 many weights", {.n = n, .numbers = {{"stride", stride}}},
                          {.rows = count, .columns = 3});
  judge(all_equal("the number drawn from the middle of its share", column(rows, 1), column(rows, 0),
                  0, {float_cdf}));
  const std::vector<double> expected(count, 1e-7);
  judge(all_equal("the probability of one of 1e7", column(rows, 2), expected, 1e-15, {float_cdf}));
}

TEST_CASE("Lab 5.4: bad weights are refused", "[lab05][ex4]") {
  for (int kind = 0; kind < bad_weight_kinds; ++kind)
    judge_refusal("Lab 5.4 refusal", bad_weights_name(kind), kind);
}

TEST_CASE("Lab 5.4: random u give each number its share, and a fraction that is uniform",
          "[lab05][ex4]") {
  constexpr std::size_t n = 400'000;
  Params params = params_of(Weights::rugged);
  params.n = n;
  const Rows rows = probe("Lab 5.4 samples", params, {.rows = n, .columns = 2});
  const std::vector<double> expected = probabilities(weights_of(Weights::rugged));
  std::vector<double> counts(expected.size());
  for (const double index : column(rows, 0)) {
    if (index >= 0 && index < number(counts.size())) counts[static_cast<std::size_t>(index)] += 1;
  }
  judge(counts_are("how often each number is drawn", counts, expected, n,
                   {"number", 0, number(counts.size())}));
  judge(uniform_on("the fractions", column(rows, 1), 0, 1));
}

TEST_CASE("Lab 5.5: samples are the inverse of the CDF and never fall where the density is 0",
          "[lab05][ex5]") {
  for (const Weights kind :
       {Weights::eighths, Weights::gaps, Weights::sixths, Weights::rugged, Weights::comb}) {
    const std::vector<double> weights = weights_of(kind), cdf = exact_cdf(weights);
    const std::vector<double> u = numbers_for(weights);
    const Rows rows = probe("Lab 5.5 inverse", params_of(kind),
                            {.rows = u.size(), .columns = 2, .finite = false});
    const double bins = number(weights.size());
    std::vector<double> at, found;
    double outside = 0, empty = 0;
    for (std::size_t i = 0; i < u.size(); ++i) {
      outside += rows.at(i, 0) >= 0 && rows.at(i, 0) < 1 ? 0 : 1;
      empty += rows.at(i, 1) > 0 ? 0 : 1;
      if (!exact_edges(kind) && near_edge(u[i], cdf)) continue;
      at.push_back(u[i]);
      found.push_back(rows.at(i, 0));
    }
    const auto inverse = [&](double v) {
      const Place place = place_of(v, cdf);
      return (place.index + place.fraction) / bins;
    };
    const auto twice = [&](double v) { return (place_of(v, cdf).index + v) / bins; };
    const auto left = [&](double v) { return place_of(v, cdf).index / bins; };
    const auto centre = [&](double v) { return (place_of(v, cdf).index + 0.5) / bins; };
    judge(equals(fmt::format("samples outside [0, 1), {}", name_of(kind)), outside, 0, 0));
    judge(equals_everywhere(fmt::format("the sample of {}", name_of(kind)), at, found, inverse,
                            1e-9, 1e-13,
                            {{twice, spent}, {left, at_the_edge}, {centre, at_the_edge}}));
    judge(holds(fmt::format("samples whose density is 0, {}", name_of(kind)), empty == 0,
                fmt::format("{:g} of {}", empty, u.size()), "none", {slips}));
  }
}

TEST_CASE("Lab 5.5: the density is that of each bin, and 0 outside [0, 1)", "[lab05][ex5]") {
  for (const Weights kind : {Weights::eighths, Weights::gaps, Weights::rugged}) {
    std::vector<double> expected = probabilities(weights_of(kind));
    const double bins = number(expected.size());
    const std::vector<double> plain = expected;
    for (double& p : expected)
      p *= bins;
    Rows rows = probe("Lab 5.5 density", params_of(kind), {.rows = expected.size() + 4});
    const std::vector<double> outside(rows.values.end() - 4, rows.values.end());
    rows.values.resize(expected.size());
    const bool unscaled = std::equal(plain.begin(), plain.end(), rows.values.begin(),
                                     [](double a, double b) { return std::abs(a - b) <= 1e-12; });
    judge(all_equal(fmt::format("the density of {}", name_of(kind)), rows.values, expected, 1e-11,
                    unscaled ? std::vector{no_width} : std::vector<Diagnosis>{}));
    judge(all_equal("the density at -0.5, just below 0, at 1 and at 1.5", outside,
                    std::vector<double>(4, 0.0), 0));
  }
}

TEST_CASE("Lab 5.5: ten million bins", "[lab05][ex5]") {
  const std::vector<double> u = hard_numbers();
  const Rows rows = probe("Lab 5.5 many bins", {.n = 10'000'000}, {.rows = u.size(), .columns = 2});
  judge(equals_everywhere(
      "the sample of 1e7 equal bins", u, column(rows, 0), [](double v) { return v; }, 0, 1e-8));
  judge(all_equal("its density", column(rows, 1), std::vector<double>(u.size(), 1.0), 1e-8));
}

TEST_CASE("Lab 5.5: samples fill every half bin by its integral", "[lab05][ex5]") {
  constexpr std::size_t n = 400'000;
  Params params = params_of(Weights::gaps);
  params.n = n;
  const Rows rows = probe("Lab 5.5 samples", params, {.rows = n});
  std::vector<double> mass;
  for (const double p : probabilities(weights_of(Weights::gaps)))
    mass.insert(mass.end(), {p / 2, p / 2});
  judge(counts_are("the samples against the density's integral over each half bin",
                   counted(rows.values, 0, 1, mass.size()), mass, n, {"x", 0, 1}));
}

namespace {

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

}  // namespace

// The first number alone decides y, for every value of the second, and x is the inverse within the
// row.
TEST_CASE("Lab 5.6: u_row decides the row, u_column the place in it", "[lab05][ex6]") {
  for (const int smooth : {0, 1}) {
    const GridInverse exact(smooth == 1 ? smooth_grid() : small_grid());
    const std::vector<double> u = hard_numbers();
    const Rows rows = probe("Lab 5.6 inverse", {.numbers = {{"smooth", smooth}}},
                            {.rows = u.size() * u.size(), .columns = 3});
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
    Rows rows =
        probe("Lab 5.6 density", {.numbers = {{"smooth", smooth}}}, {.rows = expected.size() + 4});
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
                          {.rows = u.size(), .columns = 3});
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
  const Rows rows =
      probe("Lab 5.6 samples", {.n = n, .numbers = {{"smooth", 1}}}, {.rows = n, .columns = 2});
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
