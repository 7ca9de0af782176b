#pragma once

#include "numeric/vec.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

namespace carlo {

constexpr double pi = 3.14159265358979323846;
constexpr float pi_f = 3.14159265358979323846f;

constexpr float sqr(float x) {
  return x * x;
}

/// Returns the square root, treating a negative rounding residue as zero; NaN stays NaN.
inline float safe_sqrt(float x) {
  return x < 0 ? 0.0f : std::sqrt(x);
}

/// Returns a bound on the relative error of n successive rounded float operations.
/// Source: Higham, "Accuracy and Stability of Numerical Algorithms", section 3.1.
constexpr float rounding_bound(int n) {
  constexpr float unit = std::numeric_limits<float>::epsilon() / 2;
  return static_cast<float>(n) * unit / (1 - static_cast<float>(n) * unit);
}

/// Returns the neighbouring float, above x if `up`, below it otherwise; finite x.
inline float next_float(float x, bool up) {
  if (x == 0)
    return up ? std::numeric_limits<float>::denorm_min()
              : -std::numeric_limits<float>::denorm_min();
  const auto bits = std::bit_cast<std::int32_t>(x);
  return std::bit_cast<float>(bits + ((x > 0) == up ? 1 : -1));
}

/// Moves a ray origin at `p` off the surface with normal `n`, to the side of `d`, just far enough
/// that the ray cannot hit the surface it left: by the bound `error` (absolute, per coordinate) on
/// the rounding error of `p`, and no more, so that thin gaps stay visible.
/// Source: Pharr, Jakob, Humphreys, "Physically Based Rendering", 4th ed., section 6.8.6; Ray
/// Tracing Gems, chapter 6.
inline Vec3 offset_origin(Vec3 p, Vec3 error, Vec3 n, Vec3 d) {
  const float distance = glm::dot(glm::abs(n), error);
  const Vec3 offset = glm::dot(d, n) < 0 ? -distance * n : distance * n;
  Vec3 o = p + offset;
  for (int i = 0; i < 3; ++i) {
    if (offset[i] != 0) o[i] = next_float(o[i], offset[i] > 0);
  }
  return o;
}

/// The same for a path that arrived at `p`, with wo pointing back along it, |wo| = 1. If the ray
/// leaves on the side that the path arrived from, it starts slightly before p on the path. It is
/// then also on the arriving side of any other surface that meets there, where rounding may have
/// put p beyond it, as in the corner of a room.
inline Vec3 offset_origin(Vec3 p, Vec3 error, Vec3 n, Vec3 wo, Vec3 d) {
  const bool stays = (glm::dot(n, wo) > 0) == (glm::dot(n, d) > 0);
  return offset_origin(stays ? p + 2 * glm::length(error) * wo : p, error, n, d);
}

}  // namespace carlo
