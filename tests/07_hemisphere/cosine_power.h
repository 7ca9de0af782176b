#pragma once

#include "07_hemisphere/places.h"

#include <cmath>
#include <functional>

// The densities of lab 7 are all powers of a cosine.

namespace lab07_tests {

/// -log(cos) of the angle between w and z, accurate for small and large angles; z > 0.
inline double minus_log_cosine(Double3 w) {
  return 0.5 * std::log1p((w.x * w.x + w.y * w.y) / (w.z * w.z));
}

/// The fraction of a law within w's angle to z: uniform on [0, 1) if the law is right.
using Share = std::function<double(Double3)>;

/// The law of density m / (2 pi) cos^(m-1): 1 is uniform, 2 cosine-weighted, n + 1 the lobe.
inline Share power_law(double m) {
  return [m](Double3 w) { return -std::expm1(-m * minus_log_cosine(w)); };
}
inline double power_law_pdf(double m, Double3 w) {
  return w.z > 0 ? m / (2 * pi) * std::exp(-(m - 1) * minus_log_cosine(w)) : 0;
}
/// For a law whose angle itself is uniform up to 90 degrees.
inline double uniform_angle(Double3 w) {
  return std::atan2(std::hypot(w.x, w.y), w.z) * 2 / pi;
}
/// For a law whose sine of the angle is uniform.
inline double uniform_sine(Double3 w) {
  return std::hypot(w.x, w.y) / glm::length(w);
}

/// The azimuth as a fraction of `turn`.
inline double azimuth_share(Double3 w, double turn = 2 * pi) {
  const double phi = std::atan2(w.y, w.x);
  return (phi < 0 ? phi + 2 * pi : phi) / turn;
}

/// Cells of equal mass, as many angles as azimuths.
constexpr int cells_a_side = 16;

}  // namespace lab07_tests
