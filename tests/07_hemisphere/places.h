#pragma once

#include "numeric/vec.h"

#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

// The inputs of lab 7's exercises, for the probes (floats, as students get them) and for the
// checks (the same floats, in double).

namespace lab07_tests {

using carlo::Vec2;
using carlo::Vec3;
using Double3 = glm::dvec3;

constexpr double pi = std::numbers::pi;

enum class Sampler { uniform = 0, cosine = 1, lobe = 2, mirror = 3 };

/// A direction by its angles, rounded to floats.
inline Vec3 at_angles(double theta, double phi) {
  return {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
}

/// Two axes that make a right-handed frame with the unit vector z; in double.
struct Axes {
  Double3 x, y, z;

  explicit Axes(Double3 axis) : z(glm::normalize(axis)) {
    const Double3 other = std::abs(z.x) < 0.6 ? Double3(1, 0, 0) : Double3(0, 1, 0);
    y = glm::normalize(glm::cross(z, other));
    x = glm::cross(y, z);
  }
  Double3 local(Double3 w) const { return {glm::dot(w, x), glm::dot(w, y), glm::dot(w, z)}; }
  Double3 world(Double3 w) const { return w.x * x + w.y * y + w.z * z; }
};

/// Normals in all directions, and many where frames break: on the axes, with zeros of both signs,
/// as close to n = -z and n = z as floats allow, and along vectors of small whole numbers, which
/// may be the only helper of a cross product. Other weak places are found by a search (Lab 7.1
/// search).
inline std::vector<Vec3> hard_normals() {
  std::vector<Vec3> normals = {{0, 0, 1},     {0, 0, -1},      {0.0f, -0.0f, -1}, {1, 0, 0},
                               {-1, 0, 0},    {0, 1, 0},       {0, -1, 0},        {1, 0, -0.0f},
                               {0, 1, -0.0f}, {0.6f, 0.8f, 0}, {0, 0.6f, -0.8f}};
  for (int i = 0; i < 60; ++i) {
    const double tilt = std::pow(10.0, -i / 6.0);
    for (int k = 0; k < 5; ++k) {
      normals.push_back(at_angles(pi - tilt, 1.3 * i + 1.2566 * k));
      normals.push_back(at_angles(tilt, 1.3 * i + 1.2566 * k));
      normals.push_back(at_angles(pi / 2 + tilt, 1.3 * i + 1.2566 * k));
    }
  }
  for (int i = 0; i < 9 * 9 * 9; ++i) {
    const Double3 whole(i % 9 - 4, i / 9 % 9 - 4, i / 81 - 4);
    if (glm::length(whole) > 0) normals.emplace_back(glm::normalize(whole));
  }
  constexpr int spiral = 4000;
  for (int i = 0; i < spiral; ++i) {
    normals.push_back(at_angles(std::acos(1 - (2 * i + 1.0) / spiral), 2.399963229728653 * i));
  }
  return normals;
}

constexpr Vec3 frame_local{0.3f, -0.5f, 0.8f};
constexpr Vec3 frame_world{-0.6f, 0.2f, 0.7f};

/// Numbers u in [0, 1) from a 24-bit generator, including both ends; and their pairs.
inline std::vector<Vec2> edge_numbers() {
  const std::vector<float> edges = {0,    0x1p-24f, 0x1p-23f,     0x1p-12f,     0.25f,
                                    0.5f, 0.75f,    1 - 0x1p-12f, 1 - 0x1p-23f, 1 - 0x1p-24f};
  std::vector<Vec2> pairs;
  for (const float x : edges) {
    for (const float y : edges)
      pairs.emplace_back(x, y);
  }
  return pairs;
}

/// The distance between neighbouring numbers u, in one coordinate at a time: a number of steps of a
/// 24-bit generator that is prime, so that it is not a whole number of turns of an azimuth that
/// winds.
constexpr float neighbour_step = 2011 * 0x1p-24f;

/// A neighbour of x that is also in [0, 1).
inline float neighbour(float x) {
  return x < 0.5f ? x + neighbour_step : x - neighbour_step;
}

/// Places at which densities are tested: all over the sphere, at equal steps of height and azimuth,
/// cell by cell.
constexpr int density_rings = 200, density_sectors = 32;
inline Vec3 density_place(int ring, int sector) {
  const double z = 1 - (2 * ring + 1.0) / density_rings;
  return at_angles(std::acos(z), 2 * pi * (sector + 0.5) / density_sectors);
}

/// The number of mirror directions for which Lab 7.7 tests the lobe's very edge, with this many
/// streams.
constexpr int edge_mirrors = 64, edge_streams = 48;

/// Places across a lobe of exponent n about `axis`: from its middle to where the density has fallen
/// to e^-16, or to the lobe's edge if that comes first.
constexpr int lobe_steps = 160;
inline Vec3 lobe_direction(int step, double n, Vec3 axis) {
  // cos^n = e^-s, s = 0 ... 16.
  const double s = 16.0 * step / lobe_steps;
  const double cosine = n > 0 ? std::exp(-s / n) : 1 - s / 16;
  const double sine = n > 0 ? std::sqrt(-std::expm1(-2 * s / n)) : std::sqrt(1 - cosine * cosine);
  const double phi = 2.399963229728653 * step;
  return Axes(axis).world({sine * std::cos(phi), sine * std::sin(phi), cosine});
}

}  // namespace lab07_tests
