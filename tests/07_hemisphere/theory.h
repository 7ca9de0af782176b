#pragma once

#include <cmath>
#include <numbers>

// Closed forms for the lobe about the mirror direction; theta is the angle of the mirror direction
// with the normal, n a whole number. Integrals of powers of the cosine over half a circle, solved
// by recursion.

namespace lab07_tests {

/// w_0 = pi/2, w_1 = 1, w_(j+2) = w_j (j + 1)/(j + 2): the integral of sin^j over [0, pi/2].
inline double wallis(int j) {
  double w = j % 2 == 0 ? std::numbers::pi / 2 : 1;
  for (int i = j % 2; i + 2 <= j; i += 2)
    w *= (i + 1.0) / (i + 2.0);
  return w;
}

/// The fraction of the lobe's directions below the horizon.
inline double below_horizon(int n, double theta) {
  const double c = std::cos(theta), s = std::sin(theta);
  double sum = 0;
  for (int j = n % 2 == 0 ? 1 : 0; j <= n - 1; j += 2)
    sum += std::pow(s, j) * wallis(j);
  return ((n % 2 == 0 ? theta : std::numbers::pi / 2) - c * sum) / std::numbers::pi;
}

/// The integral of (n + 2)/(2 pi) cos^n(alpha) cos(theta_i) over the hemisphere: the reflectance of
/// a Phong surface of k_s = 1 under a uniform sky.
inline double lobe_albedo(int n, double theta) {
  const double c = std::cos(theta), s = std::sin(theta);
  double sum = 0;
  for (int j = n % 2; j <= n; j += 2)
    sum += std::pow(s, j) * wallis(j);
  const double half = n % 2 == 0 ? c / 2 : c * (1 - theta / std::numbers::pi);
  return half + c * c / std::numbers::pi * sum + std::pow(s, n + 2) * wallis(n) / std::numbers::pi;
}

}  // namespace lab07_tests
