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

/// sqrt that treats the negative residue of rounding as zero; NaN stays NaN.
inline float safe_sqrt(float x) {
  return x < 0 ? 0.0f : std::sqrt(x);
}

/// A bound on the relative error of n rounded float operations in a row.
/// Source: Higham, "Accuracy and Stability of Numerical Algorithms", section 3.1.
constexpr float rounding_bound(int n) {
  constexpr float unit = std::numeric_limits<float>::epsilon() / 2;
  return static_cast<float>(n) * unit / (1 - static_cast<float>(n) * unit);
}

/// The neighbouring float, above x if `up`, below it otherwise; finite x.
inline float next_float(float x, bool up) {
  if (x == 0)
    return up ? std::numeric_limits<float>::denorm_min()
              : -std::numeric_limits<float>::denorm_min();
  const auto bits = std::bit_cast<std::int32_t>(x);
  return std::bit_cast<float>(bits + ((x > 0) == up ? 1 : -1));
}

/// A ray origin at `p` moved off the surface with normal `n`, to the side of `d`, just far enough
/// that the ray cannot meet the surface it left: by the bound `error` (absolute, per coordinate) on
/// the rounding error of `p`, and no more, so that thin gaps stay visible.
/// Source: Pharr, Jakob, Humphreys, "Physically Based Rendering", 4th ed., section 6.8.6;
/// Ray Tracing Gems, chapter 6.
inline Vec3 offset_origin(Vec3 p, Vec3 error, Vec3 n, Vec3 d) {
  const float distance = glm::dot(glm::abs(n), error);
  const Vec3 offset = glm::dot(d, n) < 0 ? -distance * n : distance * n;
  Vec3 o = p + offset;
  for (int i = 0; i < 3; ++i) {
    if (offset[i] != 0) o[i] = next_float(o[i], offset[i] > 0);
  }
  return o;
}

/// The same for a path that came to `p` from direction wo, |wo| = 1. If the ray goes on from the
/// side that the path came to, it starts a little before p on the path's way: of other surfaces
/// that meet there it is then on the side that the path came from, too, where rounding may have put
/// p beyond them. Rooms have corners.
inline Vec3 offset_origin(Vec3 p, Vec3 error, Vec3 n, Vec3 wo, Vec3 d) {
  const bool stays = (glm::dot(n, wo) > 0) == (glm::dot(n, d) > 0);
  return offset_origin(stays ? p + 2 * glm::length(error) * wo : p, error, n, d);
}

}  // namespace carlo
