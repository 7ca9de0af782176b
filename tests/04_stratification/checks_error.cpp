// Checks of exercise 4.5.

#include "04_stratification/drawn.h"
#include "04_stratification/theory.h"
#include "grader/judge/judge.h"

#include <cmath>
#include <cstddef>
#include <map>
#include <string>
#include <vector>

using namespace carlo::grader;
using namespace lab04_tests;

namespace {

const Diagnosis not_stratified{
    "points-not-in-their-cells",
    "the cells do not get per_cell points each: the points fall anywhere "
    "or in the cells of another grid."};
const Diagnosis plain_error{"strata-ignored-in-the-error",
                            "the standard error treats the points as if they could fall anywhere: "
                            "that is the plain one. With strata only the spread within the cells "
                            "counts."};
const Diagnosis by_n{"variance-divided-by-n",
                     "a cell's sum of squares is divided by the number of its points m; the "
                     "unbiased estimate takes m - 1."};
const Diagnosis of_one_point{"standard-error-of-one-point",
                             "a cell's variance is that of one point; the mean of m points has one "
                             "m-th of it."};
const Diagnosis of_mean_cell{"variances-averaged",
                             "the variance of a mean of K cells is the sum of their variances "
                             "over K squared: divide by K once more."};
const Diagnosis errors_added{"standard-errors-averaged",
                             "the cells' standard errors are averaged; it is their squares that "
                             "add."};
const Diagnosis plain_too_small{"plain-error-without-correction",
                                "the plain error is too small: value^2 is on average larger than "
                                "the squared integral, by the value's own variance."};
const Diagnosis plain_within{"plain-error-only-within",
                             "the plain error omits the differences between the cells' means."};
const Diagnosis cancellation{"sum-of-squares-cancellation",
                             "digits cancel where the mean is large: two sums of nearly equal size "
                             "are subtracted."};

struct Setup {
  int columns, rows, per_cell;

  int cells() const { return columns * rows; }
  double points() const { return static_cast<double>(cells()) * per_cell; }
  std::map<std::string, double> numbers() const {
    return {{"columns", columns}, {"rows", rows}, {"per_cell", per_cell}};
  }
};

/// Moments of x y over one cell.
struct Cell {
  double mean, variance, central_fourth, variance_of_square;
};

Cell product_cell(const Setup& of, int column, int row) {
  const auto moment = [&](int k) {
    return power_mean(k, static_cast<double>(column) / of.columns, (column + 1.0) / of.columns) *
           power_mean(k, static_cast<double>(row) / of.rows, (row + 1.0) / of.rows);
  };
  const Cumulants c = from_raw(moment(1), moment(2), moment(3), moment(4));
  return {c.mean, c.variance, c.fourth + 3 * c.variance * c.variance,
          moment(4) - moment(2) * moment(2)};
}

/// The expected values and spreads of the three results for x y.
struct Expected {
  Theory value;              ///< of value
  double squared_error = 0;  ///< mean and sd of its square
  double squared_error_sd = 0;
  double plain_squared_error = 0;  ///< mean of the plain one's square, and a bound on its sd
  double plain_squared_error_sd = 0;
  double within = 0;  ///< mean variance within the cells
};

Expected expected(const Setup& of) {
  Expected e;
  const double m = of.per_cell, k = of.cells(), n = of.points();
  Cumulants value;
  double variance_of_squares = 0, second_moment = 0, error_variance = 0;
  for (int cell = 0; cell < of.cells(); ++cell) {
    const Cell c = product_cell(of, cell % of.columns, cell / of.columns);
    const double fourth = c.central_fourth - 3 * c.variance * c.variance;
    value.add({c.mean, c.variance / m, fourth / (m * m * m)}, 1 / k);
    second_moment += (c.variance + c.mean * c.mean) / k;
    variance_of_squares += c.variance_of_square / m / (k * k);
    e.within += c.variance / k;
    // The variance of an unbiased sample variance (Kenney and Keeping, Mathematics of Statistics).
    const double of_s2 = c.central_fourth / m - c.variance * c.variance * (m - 3) / (m * (m - 1));
    error_variance += of_s2 / (m * m) / std::pow(k, 4);
  }
  e.value = value.theory();
  e.squared_error = value.variance;
  e.squared_error_sd = std::sqrt(error_variance);
  e.plain_squared_error = (second_moment - value.mean * value.mean) / n;
  // The square is (mean of y^2 - value^2 + squared error) / N. Standard deviations of summands at
  // most add; that of value^2 follows from |value^2 - I^2| <= |value - I| (1 + I), for value <= 1.
  e.plain_squared_error_sd =
      (std::sqrt(variance_of_squares) + e.value.sd * (1 + value.mean) + e.squared_error_sd) / n;
  return e;
}

std::vector<double> squares(std::vector<double> values) {
  for (double& v : values)
    v *= v;
  return values;
}

void judge_estimates(const Setup& of) {
  auto numbers = of.numbers();
  numbers["repetitions"] = 20'000;
  const Rows rows =
      probe("Lab 4.5 estimates", {.numbers = numbers}, {.rows = 20'000, .columns = 3});
  const Expected e = expected(of);
  const double m = of.per_cell, k = of.cells();
  const std::string which =
      fmt::format(", {} x {} cells with {} points each", of.columns, of.rows, of.per_cell);
  judge(mean_is("the value" + which, column(rows, 0), e.value));
  Suspects variances;
  if (of.cells() > 1) variances.push_back({e.plain_squared_error, not_stratified});
  judge(variance_is("the variance of the value" + which, column(rows, 0), e.value, variances));
  Suspects errors{{e.squared_error * (m - 1) / m, by_n}, {e.squared_error * m, of_one_point}};
  if (of.cells() > 1) {
    errors.push_back({e.plain_squared_error, plain_error});
    errors.push_back({e.squared_error * k, of_mean_cell});
  }
  judge(mean_is("the squared standard error" + which, squares(column(rows, 1)),
                {e.squared_error, e.squared_error_sd}, errors));
  const double n = of.points();
  judge(mean_is("the squared plain standard error" + which, squares(column(rows, 2)),
                {e.plain_squared_error, e.plain_squared_error_sd},
                {{e.plain_squared_error - e.squared_error / n, plain_too_small},
                 {(e.plain_squared_error - e.squared_error / n) * n / (n - 1), plain_too_small},
                 {e.within / n, plain_within},
                 {(e.within * (m - 1) / m + e.squared_error) / n, plain_within}}));
}

/// The results recomputed from the points at which f was evaluated.
struct Recomputed {
  bool stratified = true;
  double value = 0, squared_error = 0, mean_error = 0, squared_plain_error = 0;
  double within = 0;  ///< mean square of the distances from the cells' means
};

/// The values of f at the points, cell by cell; nothing if a point is outside the square.
using Cells = std::vector<std::vector<long double>>;

Cells values_by_cell(const Answer& rows, const Setup& of, double offset) {
  const DrawnPlane f = drawn_plane(rows.seed, offset);
  Cells cells(static_cast<std::size_t>(of.cells()));
  for (std::size_t i = 2; i < rows.count(); ++i) {
    const double x = rows.at(i, 0), y = rows.at(i, 1);
    if (!(x >= 0 && x < 1 && y >= 0 && y < 1)) return {};
    const int cell = static_cast<int>(y * of.rows) * of.columns + static_cast<int>(x * of.columns);
    cells[static_cast<std::size_t>(cell)].push_back(f(x, y));
  }
  return cells;
}

Recomputed recompute(const Answer& rows, const Setup& of, double offset) {
  const Cells cells = values_by_cell(rows, of, offset);
  Recomputed result;
  result.stratified = !cells.empty();
  const long double k = of.cells(), m = of.per_cell;
  long double value = 0, variance = 0, errors = 0, within = 0, between = 0;
  std::vector<long double> means;
  for (const auto& cell : cells) {
    if (cell.size() != static_cast<std::size_t>(of.per_cell)) result.stratified = false;
    long double mean = 0, spread = 0;
    for (const long double y : cell)
      mean += y / m;
    for (const long double y : cell)
      spread += (y - mean) * (y - mean);
    value += mean / k;
    means.push_back(mean);
    within += spread / (m * k);
    variance += spread / (m - 1) / m / (k * k);
    errors += std::sqrt(spread / (m - 1) / m) / k;
  }
  for (const long double mean : means)
    between += (mean - value) * (mean - value) / k;
  result.value = static_cast<double>(value);
  result.squared_error = static_cast<double>(variance);
  result.mean_error = static_cast<double>(errors);
  result.within = static_cast<double>(within);
  // The mean square about the value is less than the variance over the square by the variance of
  // the value. Every other unbiased estimate from the values alone is the same.
  result.squared_plain_error = static_cast<double>((within + between + variance) / (k * m));
  return result;
}

Answer record(const Setup& of, double offset) {
  auto numbers = of.numbers();
  numbers["offset"] = offset;
  return probe("Lab 4.5 record", {.numbers = numbers},
               {.rows = static_cast<std::size_t>(of.points()) + 2, .columns = 2, .finite = false});
}

/// Judges both errors, where the points are right. `right_at_zero`: they were right without an
/// offset, so that only cancellation can be the cause.
bool judge_errors(const Answer& rows, const Recomputed& right, const Setup& of, double offset,
                  bool right_at_zero, const std::string& which) {
  const double m = of.per_cell, k = of.cells();
  const double error = std::sqrt(right.squared_error);
  const double plain = std::sqrt(right.squared_plain_error);
  const double precision = offset > 0 ? 1e-5 : 1e-11;
  Verdict of_value = equals("the standard error" + which, rows.values[1], error, precision * error,
                            {{error * std::sqrt((m - 1) / m), by_n},
                             {error * std::sqrt(m), of_one_point},
                             {error * std::sqrt(k), of_mean_cell},
                             {right.mean_error, errors_added}});
  const double n = of.points();
  const double uncorrected = right.squared_plain_error - right.squared_error / n;
  Verdict of_plain =
      equals("the plain standard error" + which, rows.values[2], plain, precision * plain,
             {{std::sqrt(uncorrected), plain_too_small},
              {std::sqrt(uncorrected * n / (n - 1)), plain_too_small},
              {std::sqrt(right.within / n), plain_within},
              {std::sqrt((right.within + right.squared_error) / n), plain_within}});
  for (Verdict* verdict : {&of_value, &of_plain}) {
    if (!verdict->passed && right_at_zero) verdict->diagnoses.push_back(cancellation);
    judge(*verdict);
  }
  return of_value.passed && of_plain.passed;
}

}  // namespace

// 20 000 estimates each. 2 x 1 cells with 2 points: sd of the value .084, so a bias of .005 (2 %)
// is detected; for the squared error, relative sd 1.2, 7 %; for the plain one (sd bounded from
// above) 15 %, where the correction makes 18 %. One cell with 2 points: the correction is half of
// it.
TEST_CASE("Lab 4.5: value, squared error and squared plain error are right on average",
          "[lab04][ex5]") {
  judge_estimates({1, 1, 2});
  judge_estimates({2, 1, 2});
  judge_estimates({4, 3, 3});
}

// Exact up to rounding: the mean of the values is 2 to 1e8, whose last digits are 1e-8.
TEST_CASE("Lab 4.5: value and error follow from the values in each cell, whatever their mean",
          "[lab04][ex5]") {
  for (const Setup& of : {Setup{5, 3, 4}, Setup{1, 1, 16}, Setup{16, 16, 2}}) {
    bool right_at_zero = false;  // cancellation spoils only results that are right without the
                                 // offset
    for (const double offset : {0.0, 1e8}) {
      const Answer rows = record(of, offset);
      const std::string which = fmt::format(", {} x {} cells with {} points each, offset {:g}",
                                            of.columns, of.rows, of.per_cell, offset);
      judge(equals("the number of evaluations of f" + which, rows.values[3], of.points(), 0));
      const Recomputed right = recompute(rows, of, offset);
      judge(is_so("per_cell points in each cell" + which, right.stratified, "not so", "so",
                  {not_stratified}));
      if (!right.stratified) continue;
      judge(equals("the value" + which, rows.values[0], right.value, 1e-12 * right.value));
      const bool good = judge_errors(rows, right, of, offset, right_at_zero, which);
      if (offset == 0) right_at_zero = good;
    }
  }
}
