#pragma once

#include "numeric/robust.h"
#include "numeric/vec.h"
#include "random/rng.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

// The photons of Lab 9.5's probes, which its checks compute again from the probe's seed.

namespace lab09_density {

using carlo::Rgb;
using carlo::Rng;
using carlo::Vec3;

/// A copy of lab09::Photon, which the judge does not have.
struct DensityPhoton {
  Vec3 p, wi;
  Rgb flux;
  int phong, specular;
};

inline Vec3 drawn_direction(Rng& rng) {
  const float z = 1 - 2 * rng.uniform_float();
  const float phi = 2 * carlo::pi_f * rng.uniform_float();
  const float r = std::sqrt(std::max(0.0f, 1 - z * z));
  return {r * std::cos(phi), r * std::sin(phi), z};
}

/// A direction that rounding cannot move to the other side of a surface with this normal.
inline Vec3 drawn_beside(Vec3 normal, Rng& rng) {
  Vec3 d = drawn_direction(rng);
  while (std::abs(glm::dot(d, normal)) < 1e-3f)
    d = drawn_direction(rng);
  return d;
}

/// Photons around a point of a surface, up to two radii away and none at the radius itself, with a
/// flux of about the radius squared. Half of them come from either side. Distances are so far apart
/// that rounding cannot exchange them: half of an even number of photons get a different fraction
/// of the radius each.
inline std::vector<DensityPhoton> drawn_photons(Rng& rng, int count, Vec3 at, Vec3 normal,
                                                float radius) {
  std::vector<DensityPhoton> photons;
  const int half = count / 2;
  for (int i = 0; i < count; ++i) {
    DensityPhoton photon{};
    const Vec3 away = drawn_direction(rng);
    // In shuffled order: 7 and half have no common divisor.
    const auto part = static_cast<float>(i / 2 * 7 % half);
    const float within = (part + 0.05f + 0.9f * rng.uniform_float()) / static_cast<float>(half);
    const float share = i % 2 == 0 ? 0.98f * within : 1.02f + within;
    photon.p = at + radius * share * away;
    photon.wi = drawn_beside(normal, rng);
    const float red = rng.uniform_float(), green = rng.uniform_float(), blue = rng.uniform_float();
    photon.flux = radius * radius * Rgb(red, green, blue);
    photon.phong = i % 3;
    photon.specular = i / 3 % 3;
    photons.push_back(photon);
  }
  return photons;
}

/// A point of a surface and a disc about it: far from the origin, very small, and large.
struct DensityPlace {
  Vec3 at;
  float radius;
};
inline constexpr std::array<DensityPlace, 3> density_places = {
    {{{37.3f, -21.7f, 55.1f}, 0.3f}, {{0, 0, 0}, 1e-9f}, {{0, 0, 0}, 5e3f}}};
inline constexpr int density_photons = 60;

inline const Vec3 density_normal{-2 / 3.0f, -1 / 3.0f, 2 / 3.0f};
inline const Vec3 density_wo{2 / 7.0f, -3 / 7.0f, 6 / 7.0f};
inline const Rgb density_glow{0.5f, 0.25f, 2};  ///< the surface's emission

/// The BRDF there: an arbitrary function of wi, > 0.
inline Rgb density_brdf(Vec3 wi) {
  return {0.3f + 0.2f * wi.x, 0.2f + 0.1f * wi.y, 0.25f + 0.2f * wi.z};
}

/// Numbers of nearest photons.
inline constexpr std::array<int, 4> density_counts = {2, 7, 20, density_photons};

// Uniform photons ---------------------------------------------------------------------------------

/// Photons on a disc of radius 1, with a total flux of pi: their irradiance is 1.
inline constexpr int uniform_photons = 60, uniform_nearest = 12;
inline constexpr float uniform_radius = 0.4f;

}  // namespace lab09_density
