#pragma once

#include <cmath>

namespace closed_forms {

constexpr double pi = 3.14159265358979323846;

/// The directional albedo of the modified Phong lobe with ks = 1 for integer n >= 0 and a fixed
/// direction at angle theta to the normal. With S = sin, c = cos, w_0 = pi/2, w_1 = 1 and
/// w_{j+2} = w_j (j+1)/(j+2):
///   a = B + (c^2/pi) sum over j = n, n-2, ... >= 0 of S^j w_j + S^{n+2} w_n / pi,
///   B = c/2 for even n, c (1 - theta/pi) for odd n.
/// All terms are positive. Derived by integrating cos^n(alpha) cos(theta_i) over the part of the
/// lobe above the horizon.
inline double phong_albedo(int n, double theta) {
  const double S = std::sin(theta), c = std::cos(theta);
  double w = n % 2 == 0 ? pi / 2 : 1, power = n % 2 == 0 ? 1 : S, sum = power * w;
  for (int j = n % 2; j < n; j += 2) {
    w *= (j + 1.0) / (j + 2.0);
    power *= S * S;
    sum += power * w;
  }
  const double b = n % 2 == 0 ? c / 2 : c * (1 - theta / pi);
  return b + c * c / pi * sum + power * S * S * w / pi;
}

/// The probability that a direction drawn from the lobe falls below the horizon.
inline double phong_below(int n, double theta) {
  const double S = std::sin(theta), c = std::cos(theta);
  const bool odd = n % 2 == 1;
  double w = odd ? pi / 2 : 1, power = odd ? 1 : S, sum = 0;
  for (int j = odd ? 0 : 1; j <= n - 1; j += 2) {
    sum += power * w;
    w *= (j + 1.0) / (j + 2.0);
    power *= S * S;
  }
  return ((odd ? pi / 2 : theta) - c * sum) / pi;
}

/// Irradiance from a sphere of radiance 1 at a distance of `h` radii, its centre at angle theta to
/// the normal, entirely above the horizon.
inline double sphere_irradiance(double h, double theta) {
  return pi * std::cos(theta) / (h * h);
}

/// Irradiance from a parallel disk of radiance 1: radius r, height h, offset o.
inline double disk_irradiance(double r, double h, double o) {
  const double a = o * o + h * h, r2 = r * r;
  return pi / 2 * (1 - (a - r2) / std::sqrt((a + r2) * (a + r2) - 4 * r2 * o * o));
}

/// Irradiance from a parallel rectangle of radiance 1, x by y over its distance, above its corner.
inline double rectangle_irradiance(double x, double y) {
  const double sx = std::sqrt(1 + x * x), sy = std::sqrt(1 + y * y);
  return 0.5 * (x / sx * std::atan(y / sx) + y / sy * std::atan(x / sy));
}

/// The same for a perpendicular rectangle that touches the plane: x = height / width,
/// y = distance / width.
inline double perpendicular_irradiance(double x, double y) {
  const double r = std::sqrt(x * x + y * y);
  return 0.5 * (std::atan(1 / y) - y / r * std::atan(1 / r));
}

}  // namespace closed_forms
