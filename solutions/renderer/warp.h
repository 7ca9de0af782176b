#pragma once

#include "numeric/robust.h"
#include "numeric/vec.h"

#include <algorithm>
#include <cmath>

namespace renderer {

using carlo::pi_f;
using carlo::Vec2;
using carlo::Vec3;

/// Two unit vectors that make (s, t, n) a right-handed orthonormal frame; |n| = 1.
/// Source: Duff et al., "Building an orthonormal basis, revisited", JCGT 6(1), 2017: exact to
/// rounding for every n, where Frisvad's version breaks down near n.z = -1.
struct Frame {
  Vec3 s, t, n;

  explicit Frame(Vec3 normal) : n(normal) {
    const float sign = std::copysign(1.0f, n.z);
    const float a = -1 / (sign + n.z);
    const float b = n.x * n.y * a;
    s = {1 + sign * n.x * n.x * a, sign * b, -sign * n.x};
    t = {b, sign + n.y * n.y * a, -n.y};
  }

  Vec3 to_world(Vec3 local) const { return local.x * s + local.y * t + local.z * n; }
};

// Each sampler is followed by its pdf. u is uniform in [0, 1)^2; directions are in a frame whose z
// is the axis; pdfs are per solid angle. Elementary functions are computed in double and rounded:
// float versions differ between standard libraries, and within one library between processors.

/// The unit vector of azimuth 2 pi u in the plane.
inline Vec2 on_circle(float u) {
  const double phi = 2 * carlo::pi * static_cast<double>(u);
  return {static_cast<float>(std::cos(phi)), static_cast<float>(std::sin(phi))};
}

/// The direction with the given cosine and sine of its polar angle and azimuth 2 pi u.
inline Vec3 spherical(float cos_theta, float sin_theta, float u) {
  return {sin_theta * on_circle(u), cos_theta};
}

/// Density cos(theta) / pi on the upper hemisphere. Lecture, "Reflected Ray Sampling".
inline Vec3 sample_cosine_hemisphere(Vec2 u) {
  return spherical(std::sqrt(1 - u.x), std::sqrt(u.x), u.y);
}
inline float cosine_hemisphere_pdf(float cos_theta) {
  return std::max(0.0f, cos_theta) / pi_f;
}

/// Uniform in a cone about z. Takes 1 - cos(half-angle), since for a small light the cosine itself
/// rounds to 1.
inline Vec3 sample_cone(Vec2 u, float one_minus_cos) {
  const float h = u.x * one_minus_cos;
  return spherical(1 - h, carlo::safe_sqrt(h * (2 - h)), u.y);
}
inline float cone_pdf(float one_minus_cos) {
  return 1 / (2 * pi_f * one_minus_cos);
}

/// Density (n+1)/(2 pi) cos^n(alpha) about z, n >= 0. Lecture, "recipe for sampling specular term":
/// cos(alpha) = z^(1/(n+1)), with sin^2(alpha) = -expm1(2 ln z / (n+1)), which stays accurate when
/// n is large and the cosine rounds to 1.
inline Vec3 sample_lobe(Vec2 u, float n) {
  const double log_cos = std::log1p(-static_cast<double>(u.x)) / (static_cast<double>(n) + 1);
  return spherical(static_cast<float>(std::exp(log_cos)),
                   static_cast<float>(std::sqrt(-std::expm1(2 * log_cos))), u.y);
}

/// cos^n(alpha) of the angle between two unit vectors, 0 for alpha >= 90 degrees. Computed from
/// their difference, |a - b|^2 / 2 = 1 - cos(alpha), so that a cosine of 1 + 1e-7 is not raised to
/// the power 1e7.
inline float cos_power(Vec3 a, Vec3 b, float n) {
  const Vec3 d = a - b;
  const float one_minus_cos = 0.5f * glm::dot(d, d);
  if (!(one_minus_cos < 1)) return 0;
  return static_cast<float>(
      std::exp(static_cast<double>(n) * std::log1p(-static_cast<double>(one_minus_cos))));
}
inline float lobe_pdf(float cos_to_n, float n) {
  return (n + 1) / (2 * pi_f) * cos_to_n;
}

}  // namespace renderer
