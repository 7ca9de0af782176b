#pragma once

#include "numeric/vec.h"

#include <fmt/core.h>

#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

// The materials, directions and cones of lab 8's probes, which the checks use too.

namespace lab08_tests {

using carlo::Rgb;
using carlo::Vec3;

/// One of a probe's values.
inline double number(float x) {
  return static_cast<double>(x);
}

/// Grey Phong materials.
struct PhongCase {
  float kd, ks, n;
};

inline std::string name_of(const PhongCase& c) {
  return fmt::format("kd = {:g}, ks = {:g}, n = {:g}", c.kd, c.ks, c.n);
}

inline std::vector<PhongCase> phong_cases() {
  return {{0.5f, 0, 0},     {0, 0.8f, 0},    {0, 0.8f, 1},      {0.3f, 0.6f, 2.5f},
          {0.2f, 0.5f, 50}, {0, 0.9f, 1e6f}, {0.1f, 0.8f, 1e7f}};
}

inline std::vector<std::pair<Rgb, Rgb>> chance_cases() {
  return {{Rgb(0.5f), Rgb(0)},
          {Rgb(0), Rgb(0.25f)},
          {{0.1f, 0.3f, 0.2f}, {0.4f, 0.1f, 0.5f}},
          {{1, 0, 0}, {0, 1, 0}},
          {{0.9f, 0.1f, 0.1f}, {0.05f, 0.3f, 0.2f}},
          {Rgb(0), Rgb(0)}};
}

/// An orthonormal frame that is not the world's.
struct Frame3 {
  Vec3 s, t, n;
  Vec3 at(Vec3 v) const { return glm::normalize(v.x * s + v.y * t + v.z * n); }
};

inline Frame3 tilted_frame() {
  return {{2 / 3.0f, -2 / 3.0f, 1 / 3.0f},
          {1 / 3.0f, 2 / 3.0f, 2 / 3.0f},
          {-2 / 3.0f, -1 / 3.0f, 2 / 3.0f}};
}

inline Vec3 direction_at(float degrees, float azimuth_degrees) {
  const float to_radians = 3.14159265f / 180;
  const float theta = degrees * to_radians, phi = azimuth_degrees * to_radians;
  return {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
}

struct DirectionPair {
  Vec3 normal, wo, wi;
};

/// wi all over the sphere, and around the mirror direction of wo at angles of the lobe's width.
inline std::vector<DirectionPair> direction_pairs(float exponent) {
  const Frame3 frame = tilted_frame();
  std::vector<DirectionPair> pairs;
  for (const float out : {0.0f, 30.0f, 60.0f, 85.0f}) {
    const Vec3 wo = frame.at(direction_at(out, 0));
    for (const float in : {5.0f, 45.0f, 80.0f, 89.0f, 91.0f, 120.0f}) {
      for (const float azimuth : {0.0f, 100.0f, 180.0f, 250.0f})
        pairs.push_back({frame.n, wo, frame.at(direction_at(in, azimuth))});
    }
    const float width = 180 / 3.14159265f / std::sqrt(exponent + 1);
    for (const float off : {0.0f, 0.3f, 1.0f, 2.0f})
      pairs.push_back({frame.n, wo, frame.at(direction_at(out - off * width / 2, 180))});
  }
  return pairs;
}

/// Lights as cones over a floor with normal +z.
struct SplitCase {
  Vec3 axis;
  float one_minus_cos;
  float light, elsewhere;  ///< radiance inside the cone and outside
};

inline std::vector<SplitCase> split_cases() {
  const Vec3 slanted = direction_at(50, 30), low = direction_at(85, 200),
             under = direction_at(120, 0);
  return {{{0, 0, 1}, 0.2f, 5, 1},
          {slanted, 0.005f, 100, 1},
          {slanted, 0.2f, 0, 1},
          {low, 0.1f, 10, 1},
          {under, 0.1f, 10, 1}};
}

}  // namespace lab08_tests
