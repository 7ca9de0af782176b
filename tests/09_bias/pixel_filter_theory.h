#pragma once

#include "09_bias/pixel_filter_data.h"
#include "grader/judge/judge.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

// Closed forms for Lab 9.2's checks.

namespace lab09_pixels {

/// Names for statistical comparisons: they are the same in all gradings, so that a calibration
/// recognises them.
inline std::string curve_of(const FilterCase& filter) {
  if (filter.curve == box_curve) return "a box";
  return filter.curve == tent_curve ? "a tent" : "a Gaussian";
}

inline std::string name_of(const FilterCase& filter) {
  const std::string name = fmt::format("{} of radius {:.4g}", curve_of(filter), filter.radius);
  return filter.curve == gaussian_curve ? fmt::format("{} and sigma {:.4g}", name, filter.sigma)
                                        : name;
}

/// A Gaussian with height 1 at its middle.
inline double bell(double x, double sigma) {
  return std::exp(-x * x / (2 * sigma * sigma));
}

/// The fraction of an untruncated Gaussian that is kept.
inline double kept_share(const FilterCase& filter) {
  return std::erf(filter.radius / (filter.sigma * std::numbers::sqrt2));
}

/// The truncated curve with height 1 at its middle.
inline double curve_shape(const FilterCase& filter, double x) {
  if (std::abs(x) > filter.radius) return 0;
  if (filter.curve == box_curve) return 1;
  if (filter.curve == tent_curve) return 1 - std::abs(x) / filter.radius;
  return bell(x, filter.sigma);
}

/// The integral of curve_shape().
inline double shape_area(const FilterCase& filter) {
  if (filter.curve == box_curve) return 2 * filter.radius;
  if (filter.curve == tent_curve) return filter.radius;
  return filter.sigma * std::sqrt(2 * std::numbers::pi) * kept_share(filter);
}

inline double filter_density(const FilterCase& filter, double x, double y) {
  const double area = shape_area(filter);
  return curve_shape(filter, x) * curve_shape(filter, y) / (area * area);
}

/// The fraction of one axis beyond a distance >= 0 on one side, without loss of digits.
inline double share_beyond(const FilterCase& filter, double distance) {
  const double d = std::min(distance / filter.radius, 1.0);
  if (filter.curve == box_curve) return (1 - d) / 2;
  if (filter.curve == tent_curve) return (1 - d) * (1 - d) / 2;
  const auto tail = [&](double t) {
    return std::erfc(t * filter.radius / (filter.sigma * std::numbers::sqrt2)) / 2;
  };
  return (tail(d) - tail(1)) / kept_share(filter);
}

/// The fraction of one axis below x.
inline double share_before(const FilterCase& filter, double x) {
  const double beyond = share_beyond(filter, std::abs(x));
  return x < 0 ? beyond : 1 - beyond;
}

/// The position below which the fraction u lies.
inline double place_of(const FilterCase& filter, double u) {
  const double beyond = std::min(u, 1 - u);
  double low = 0, high = filter.radius;
  for (int i = 0; i < 60; ++i) {
    const double middle = (low + high) / 2;
    (share_beyond(filter, middle) > beyond ? low : high) = middle;
  }
  return u < 0.5 ? -low : low;
}

/// Mean and mean square of weighted_pixel() with one or two rays, for a tent and an edge at the
/// fraction `edge` of its radius, beyond which it is lit.
///
/// Along x, t = 1 - |x|/radius is uniform; for lit points, which have probability c/2, on [0, c], c
/// = 1 - edge. A weight is t of x times t of y, and minus the logarithm of the product of two such
/// numbers has the density v exp(-v).
struct WeightedEdge {
  double mean = 0, square = 0;
};
inline WeightedEdge weighted_edge(double edge, int rays) {
  const double c = 1 - edge, lit = c / 2;
  if (rays == 1) return {lit, lit};
  WeightedEdge sum;
  constexpr int steps = 400;
  constexpr double step = 0.1;
  for (int i = 0; i < steps; ++i) {
    for (int j = 0; j < steps; ++j) {
      const double v = (i + 0.5) * step, w = (j + 0.5) * step;
      const double chance = v * std::exp(-v) * w * std::exp(-w) * step * step;
      const double against_any = c * std::exp(-v) / (c * std::exp(-v) + std::exp(-w));
      const double against_lit = std::exp(-v) / (std::exp(-v) + std::exp(-w));
      sum.mean += chance * 2 * lit * against_any;
      sum.square +=
          chance * 2 * lit * (against_any * against_any + lit * against_lit * (1 - against_lit));
    }
  }
  return sum;
}

}  // namespace lab09_pixels
