#pragma once

// Lab 04: stratification. The contract: what each exercise takes and returns. Do not edit this
// file; your work goes into stratification.cpp.

#include "random/rng.h"

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace lab04 {

/// Integrands on [0, 1), on the unit square [0, 1)^2 and on the unit cube [0, 1)^d, where the point
/// has one coordinate per dimension.
using Function = std::function<double(double)>;
using Function2d = std::function<double(double x, double y)>;
using FunctionNd = std::function<double(std::span<const double>)>;

/// A point of the unit square: 0 <= x, y < 1.
struct Point {
  double x = 0, y = 0;
};

/// Lab 4.1. The average of f over [0, 1) from one uniform point in each of the n strata [i/n,
/// (i+1)/n), i = 0 ... n-1; n >= 1. Evaluates f n times, draws one rng.uniform() per stratum.
double stratified_average(const Function& f, std::int64_t n, carlo::Rng& rng);

/// Lab 4.2. A float in stratum i of n, at the fraction u of its width: (i + u)/n to float
/// precision, and certainly within the stratum: i <= x n < i + 1 for the returned x, with x n taken
/// exactly. So x < 1 always. 0 <= i < n <= 2^20, 0 <= u < 1.
float place_in_stratum(std::int32_t i, std::int32_t n, float u);

/// Lab 4.3. Jittered points: one uniform point in each cell of a grid of `columns` by `rows` equal
/// cells, the cells in reading order: point number row * columns + column has its x in stratum
/// `column` of `columns` and its y in stratum `row` of `rows`. columns, rows >= 1.
std::vector<Point> jittered(std::int64_t columns, std::int64_t rows, carlo::Rng& rng);

/// Lab 4.4. A Latin hypercube of n points in `dimensions` dimensions: along every axis each of the
/// n strata [i/n, (i+1)/n) holds exactly one point. The strata of a point are chosen by
/// permutations that are uniform and independent from axis to axis; within its strata it is
/// uniform. Coordinate k of point j is at [j * dimensions + k]. n, dimensions >= 1.
std::vector<double> latin_hypercube(std::int64_t n, std::int64_t dimensions, carlo::Rng& rng);

/// An estimate, its error, and the error that it would have without strata.
struct StratifiedEstimate {
  double value = 0;
  double standard_error = 0;        ///< of value; its square is unbiased
  double plain_standard_error = 0;  ///< of an average of as many points over the whole square,
                                    ///< estimated from the same values of f; its square is unbiased
};

/// Lab 4.5. The average of f over the unit square from `per_cell` uniform points in each of columns
/// * rows cells. columns, rows >= 1, per_cell >= 2. Evaluates f columns * rows * per_cell times.
/// The errors do not suffer the cancellation of sums of squares when the mean is large.
StratifiedEstimate stratified_estimate(const Function2d& f, std::int64_t columns, std::int64_t rows,
                                       std::int64_t per_cell, carlo::Rng& rng);

/// An estimate and its standard error.
struct Estimate {
  double value = 0;
  double standard_error = 0;
};

/// A box that recursive stratification did not split any further: lower[k] <= x[k] < upper[k], and
/// the number of its points that went into the estimate.
struct Stratum {
  std::vector<double> lower, upper;
  std::int64_t points = 0;
};

/// Lab 4.6. The average of f over the unit cube in `dimensions` dimensions by recursive
/// stratification: a box is halved along one axis, chosen with the help of a few points of its own,
/// the half that varies more gets more of the remaining points, and each half is treated likewise
/// until few points are left. Points that chose a split are not used again, so that the estimate is
/// unbiased. At most n evaluations of f; up to n = 65536 at least n/4 of them in the estimate; n >=
/// 16, dimensions >= 1. If `strata` is not null, the boxes that the cube ended up in are appended
/// to it; together they fill the cube, each with two points or more. Its mean squared error,
/// relative to that of n plain points: at most 1 on a quarter disc in the square and on exp(-|x|^2)
/// in four dimensions, at most .5 on the latter in two (n = 1024 each) and on a narrow peak (n =
/// 4096); never more than 3, not even where strata gain nothing. On a square where f varies only in
/// a corner of 1/16, at least .13 of the points lie there (n = 16384). Where f varies along only
/// one axis of three, that one is halved at least 1.3 times as often as each other (n = 65536).
Estimate recursive_stratification(const FunctionNd& f, std::int64_t dimensions, std::int64_t n,
                                  carlo::Rng& rng, std::vector<Stratum>* strata = nullptr);

}  // namespace lab04
