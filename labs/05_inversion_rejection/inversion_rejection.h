#pragma once

// Lab 05: inversion and rejection. The contract: what each exercise takes and returns. Do not edit
// this file; your work goes into inversion_rejection.cpp.
//
// A sampler by inversion is the inverse of a cumulative distribution function (CDF): it takes any
// double u in [0, 1), including 0 and the last double below 1, returns a finite number and grows
// with u. Each sampler is followed by its pdf: a density per unit of x (or of area), 0 outside the
// support, which includes both ends unless it is written "[0, 1)". At an end the density itself may
// be 0.

#include "random/rng.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace lab05 {

/// Lab 5.1. Exponential: density rate exp(-rate x) on x >= 0; rate > 0. The sample has a relative
/// error below 1e-12 for every u, however small. Free paths in fog are distributed like this.
double sample_exponential(double u, double rate);
double exponential_pdf(double x, double rate);

/// Lab 5.2. Linear on [0, 1]: density proportional to the straight line from f0 >= 0 at x = 0 to
/// f1 >= 0 at x = 1, not both 0; equal or nearly equal ends lose no digits. Ends are below 1e150
/// and, unless 0, above 1e-150.
double sample_linear(double u, double f0, double f1);
double linear_pdf(double x, double f0, double f1);

/// Lab 5.2. Tent on [-radius, radius]: highest at 0, falling linearly to 0 at both ends; radius >
/// 0. Samples the tent filter with which pixels are often weighted.
double sample_tent(double u, double radius);
double tent_pdf(double x, double radius);

/// Lab 5.3. Power on [0, 1]: density proportional to x^n for real n >= 0, up to 1e7. x = 1 may be
/// returned where n is so large that rounding leaves no other choice.
double sample_power(double u, double n);
double power_pdf(double x, double n);

/// Lab 5.4. The numbers 0 ... n-1, drawn with probabilities proportional to given weights.
class Discrete {
 public:
  /// No numbers at all: size() is 0 and nothing can be drawn.
  Discrete() = default;
  /// Any count >= 1 of finite weights >= 0, not all 0; throws carlo::Error otherwise. If their sum
  /// exceeds the largest double, it may throw as well, or give them their correct probabilities.
  /// 1e7 equal weights keep their probabilities to a relative 1e-8; the last CDF entry is 1. A
  /// weight of 1e-9 of the total is drawn once in 1e9 times, to a relative 1e-5: sums and u are
  /// double.
  explicit Discrete(std::span<const double> weights);

  /// The result of one u: the number drawn, and where u lies in that number's share of [0, 1), as a
  /// fraction in [0, 1). The fraction is uniform and independent of the index: use it for the next
  /// decision instead of u, which is spent.
  struct Pick {
    std::size_t index;
    double fraction;
  };
  /// The smallest index whose CDF is above u, in O(log n). Weight 0 is never drawn.
  Pick sample(double u) const;
  /// index < size().
  double probability(std::size_t index) const;

  std::size_t size() const { return cdf_.size(); }

 private:
  std::vector<double> cdf_;  ///< cdf_[i] = P(number <= i)
};

/// Lab 5.5. A table on [0, 1): n bins of equal width, in each a constant density proportional to
/// the bin's weight. Weights as for Discrete.
class Tabulated1d {
 public:
  explicit Tabulated1d(std::span<const double> weights);
  /// x in [0, 1), never in a bin of weight 0: pdf(sample(u)) > 0 for every u.
  double sample(double u) const;
  double pdf(double x) const;

  std::size_t size() const { return bins_.size(); }

 private:
  Discrete bins_;
};

/// A point of the plane.
struct Point {
  double x = 0, y = 0;
};

/// Lab 5.6. A table on the unit square, such as an image that gives light: cell (column i, row j)
/// covers [i/width, (i+1)/width) x [j/height, (j+1)/height) and has weight weights[j width + i].
/// Whole rows may be 0. Weights as for Discrete, width height of them; throws carlo::Error
/// otherwise.
class Tabulated2d {
 public:
  Tabulated2d(std::span<const double> weights, std::size_t width, std::size_t height);
  /// u_row decides y by the rows' sums, u_column decides x within that row: each coordinate grows
  /// with its own number, so stratified numbers give stratified points. Never in a cell of weight
  /// 0.
  Point sample(double u_row, double u_column) const;
  /// Density per unit area.
  double pdf(Point p) const;

  std::size_t rows() const { return rows_.size(); }

 private:
  Discrete rows_;
  std::vector<Discrete> columns_;  ///< the columns of each row; empty where the row is 0
};

/// The result of rejection: the accepted value, and how many darts it took (including the accepted
/// one).
template <class T>
struct Accepted {
  T value;
  std::int64_t darts;
};

using Function = std::function<double(double)>;

/// Rejection gives up after this many darts without success.
constexpr std::int64_t max_darts = 10'000'000;

/// Lab 5.7. A number with density proportional to f on [a, b), a < b, where 0 <= f <= f_max; b
/// itself may be returned because of rounding. f need not be normalised. A dart draws x first, then
/// y: exactly two rng.uniform(); f is evaluated once per dart. Throws carlo::Error when f(x) is
/// above f_max, negative or NaN, and after max_darts darts in vain.
Accepted<double> sample_by_rejection(const Function& f, double a, double b, double f_max,
                                     carlo::Rng& rng);
/// The fraction of darts accepted, from the integral of f over [a, b).
double acceptance_rate(double integral, double a, double b, double f_max);

/// Lab 5.8. Uniform points of the unit disc around 0. By rejection: darts at the square [-1, 1)^2,
/// x first, then y. By inversion: u_radius decides the distance from 0 and grows with it, u_angle
/// the angle 2 pi u_angle from the x axis towards the y axis; no dart is lost. (Rounding may put a
/// point 1e-16 outside.)
Accepted<Point> disc_by_rejection(carlo::Rng& rng);
Point disc_by_inversion(double u_radius, double u_angle);
/// Density per unit area; points with x^2 + y^2 <= 1 belong to the disc.
double disc_pdf(Point p);

}  // namespace lab05
