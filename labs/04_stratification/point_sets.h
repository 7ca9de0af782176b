#pragma once

#include "random/rng.h"
#include "stratification.h"

#include <cstdint>
#include <string>
#include <vector>

namespace lab04 {

/// A way to place n points in the unit square, each of them uniform by itself, and how the error of
/// an average over them falls with n in theory.
struct PointSet {
  std::string name;
  std::vector<Point> (*make)(std::int64_t n, carlo::Rng& rng);
  const char* smooth_slope;  ///< for a smooth integrand
  const char* edge_slope;    ///< for an integrand that jumps along a curve
};

/// Random, jittered (Lab 4.3), Latin hypercube (Lab 4.4), Halton with a random shift, Sobol' with
/// Owen's scrambling. Jittered points need a square number n; the last two are best at powers of
/// two.
std::vector<PointSet> all_point_sets();

/// An integrand on the unit square with its exact average.
struct Integrand {
  std::string name;
  double (*f)(double x, double y);
  double average = 0;
};

/// exp(-x^2 - y^2): smooth.
Integrand bell();
/// 4 inside the quarter of the unit circle: darts thrown at pi.
Integrand darts();
/// A narrow bell at (.25, .3): almost all of the square is empty.
Integrand peak();

constexpr double peak_sharpness = 200, peak_x = 0.25, peak_y = 0.3;

/// The mean of f over the points.
double average_over(const std::vector<Point>& points, const Integrand& integrand);

}  // namespace lab04
