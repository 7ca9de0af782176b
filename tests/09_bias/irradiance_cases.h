#pragma once

#include "numeric/vec.h"
#include "random/rng.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

// Shared by the probes and checks of exercise 9.7: surroundings of a point, records, and points
// that need irradiance.

namespace lab09_tests {

using carlo::Rgb;
using carlo::Rng;
using carlo::Vec3;
using Double3 = glm::dvec3;

/// Normals all around, along the axes and close to -z.
inline std::vector<Vec3> record_normals() {
  std::vector<Vec3> normals = {{0, 0, 1}, {0, 0, -1}, {1, 0, 0}, {0, -1, 0}};
  for (const Vec3 n : {Vec3(0.6f, 0, 0.8f), Vec3(-2, 1, 3), Vec3(1, 2, -2), Vec3(1e-3f, 0, -1)})
    normals.push_back(glm::normalize(n));
  return normals;
}

/// Unit vectors at right angles to each other and to n.
struct Tangents {
  Double3 s, t;
  explicit Tangents(Double3 n)
      : s(glm::normalize(glm::cross(n, std::abs(n.x) < 0.7 ? Double3(1, 0, 0) : Double3(0, 1, 0)))),
        t(glm::cross(n, s)) {}
};

enum class Around {
  room,       ///< radiance and distances of many sizes
  half_open,  ///< a ceiling over one half, nothing over the other
  open,       ///< nothing anywhere
  ball,       ///< inside a ball of radius 2, 1 above its middle along the normal
  ceiling     ///< a plane at height 1
};

struct Arrived {
  Double3 radiance;
  double distance;
};

/// The radiance and distance in direction wi from a point with this normal.
inline Arrived arrived(Around around, Double3 n, Double3 wi, double scale) {
  const Tangents axes(n);
  const Double3 walls(1, 2, 4);
  const double cosine = std::max(glm::dot(n, wi), 1e-9), across = glm::dot(axes.s, wi);
  switch (around) {
    case Around::room:
      return {{1 + 0.5 * across, glm::dot(axes.t, wi) > 0 ? 3 : 0, 0.25 + cosine},
              scale * std::pow(10, 2 * across)};
    case Around::half_open:
      if (across > 0) return {0.5 * walls, std::numeric_limits<double>::infinity()};
      return {walls, scale / cosine};
    case Around::open:
      return {walls, std::numeric_limits<double>::infinity()};
    case Around::ball:
      return {walls, scale * (std::sqrt(cosine * cosine + 3) - cosine)};
    case Around::ceiling:
      break;
  }
  return {walls, scale / cosine};
}

/// A record, as known to both sides.
struct KnownRecord {
  Vec3 p, n;
  Rgb E;
  double distance;
};

struct Query {
  const char* name;
  std::vector<KnownRecord> records;
  Vec3 p, n;
  double most;
};

constexpr double endless = std::numeric_limits<double>::infinity();

inline Vec3 turned(double angle) {
  return Vec3(Double3(std::sin(angle), 0, std::cos(angle)));
}

inline std::vector<Query> named_queries() {
  const Vec3 o(0), up(0, 0, 1);
  const Rgb a(1, 2, 4), b(8, 1, 3);
  const auto at = [&](float x, float z, Rgb E, double distance = 1) {
    return KnownRecord{{x, 0, z}, up, E, distance};
  };
  return {
      {"no record", {}, o, up, 0.5},
      {"one record", {at(0.25f, 0, a)}, o, up, 0.5},
      {"one too far away", {at(0.75f, 0, a)}, o, up, 0.5},
      {"two records", {at(0.25f, 0, a), at(-0.5f, 0, b)}, o, up, 1},
      {"two, one too far away", {at(0.25f, 0, a), at(-0.5f, 0, b)}, o, up, 0.4},
      {"one right there, and another", {at(-0.25f, 0, b), at(0, 0, a)}, o, up, 0.5},
      {"one right there, turned by 1e-6", {at(-0.25f, 0, b), {o, turned(1e-6), a, 1}}, o, up, 0.5},
      {"two of infinite distance",
       {{{3, 0, 0}, turned(0.3), a, endless}, {{-9, 1, 0}, turned(-0.6), b, endless}},
       o,
       up,
       0.9},
      {"one turned too far", {{o, turned(1), a, 1}}, o, up, 0.5},
      {"one in front", {at(0.1f, 0.05f, a)}, o, up, 0.5},
      {"one behind", {at(0.1f, -0.05f, a)}, o, up, 0.5},
      {"one in front by less than a hundredth", {at(0.1f, 0.005f, a)}, o, up, 0.5},
      {"a wide one in front by less than a hundredth", {at(3, 0.3f, a, 40)}, o, up, 0.5},
      {"a narrow one in front by more", {at(5e-4f, 1e-4f, a, 2e-3)}, o, up, 0.5},
      {"around a ridge", {{{0.2f, 0, -0.02f}, turned(0.4), a, 1}}, o, up, 0.6},
      {"in a hollow", {{{0.2f, 0, 0.06f}, turned(-0.4), a, 1}}, o, up, 0.6},
      {"tiny", {at(2e-5f, 0, a, 1e-4), at(-4e-5f, 0, b, 1e-4)}, o, up, 0.5},
      {"huge", {at(2e5f, 0, a, 1e6), at(-4e5f, 0, b, 1e6)}, o, up, 0.5}};
}

/// A record and a point at which its error is needed.
struct ErrorCase {
  KnownRecord record;
  Vec3 p, n;
};

inline std::vector<ErrorCase> error_cases() {
  std::vector<ErrorCase> cases;
  const Vec3 up(0, 0, 1), o(0);
  const auto add = [&](Vec3 n, Vec3 turn, Vec3 p, double distance) {
    cases.push_back({{o, turn, Rgb(1), distance}, p, n});
  };
  for (const float away : {0.125f, 0.5f, 3.0f})
    add(up, up, {0, away, 0}, 2);
  for (const double angle : {1e-6, 1e-5, 1e-3, 0.02, 0.5, 1.0, 1.6, 3.0})
    add(up, turned(angle), o, 1);
  // The same normal twice: where rounding has made it slightly longer than 1, n . n is above 1.
  for (int i = 1; i <= 24; ++i)
    add(turned(0.06 * i), turned(0.06 * i), o, 1);
  for (const double angle : {0.0, 1e-3, 0.2, 1.0})
    add(turned(0.7), turned(0.7 + angle), {0.3f, -0.4f, 1.2f}, 4);
  add(up, turned(0.3), {100, 0, 0}, endless);
  add(up, turned(0.3), {2e-5f, 0, 0}, 1e-4);
  add(up, turned(0.3), {2e5f, 0, 0}, 1e6);
  return cases;
}

inline Vec3 tilted(Rng& rng, double most) {
  const double angle = most * rng.uniform(), turn = 6.28 * rng.uniform();
  return Vec3(
      Double3(std::sin(angle) * std::cos(turn), std::sin(angle) * std::sin(turn), std::cos(angle)));
}

/// How far the record lies in front, in units of its distance, along the mean of the normals.
inline double in_front(const KnownRecord& r, Vec3 p, Vec3 n) {
  return glm::dot(Double3(r.p) - Double3(p), (Double3(n) + Double3(r.n)) / 2.0) / r.distance;
}
inline double true_error(const KnownRecord& r, Vec3 p, Vec3 n) {
  return glm::length(Double3(p) - Double3(r.p)) / r.distance +
         glm::length(Double3(n) - Double3(r.n)) / std::sqrt(2.0);
}

/// Lists of records around the origin, none of them so near a limit that rounding decides.
inline std::vector<Query> drawn_queries(std::uint64_t seed, std::int64_t count) {
  Rng rng(seed);
  std::vector<Query> all;
  while (static_cast<std::int64_t>(all.size()) < count) {
    Query q{"drawn at random", {}, {0, 0, 0}, tilted(rng, 0.5), 0.3 + 0.5 * rng.uniform()};
    while (q.records.size() < 8) {
      const double distance = 0.5 + rng.uniform();
      const double x = 1.6 * rng.uniform() - 0.8, y = 1.6 * rng.uniform() - 0.8,
                   z = 0.2 * rng.uniform() - 0.1;
      const double red = rng.uniform(), green = rng.uniform(), blue = rng.uniform();
      const KnownRecord r{Vec3(Double3(x, y, z)), tilted(rng, 0.5), Rgb(Double3(red, green, blue)),
                          distance};
      const bool near_limit = std::abs(true_error(r, q.p, q.n) - q.most) < 1e-3 ||
                              std::abs(in_front(r, q.p, q.n) - 0.01) < 2e-3;
      if (!near_limit) q.records.push_back(r);
    }
    all.push_back(q);
  }
  return all;
}

/// Points that query a cache one after the other.
struct Asker {
  Vec3 p, n;
};

constexpr double cache_most = 0.3;

/// The record made at a point, with a shorter distance near the edge between floor and wall.
inline KnownRecord made_at(Vec3 p, Vec3 n) {
  return {p, n, Rgb(1 + p.x, 2 + p.y + 3 * p.z, 1), 0.2 + static_cast<double>(p.x + p.z)};
}

/// True if rounding may decide whether one point's record serves the other.
inline bool too_close_to_call(const Asker& maker, const Asker& asker) {
  const KnownRecord record = made_at(maker.p, maker.n);
  return std::abs(true_error(record, asker.p, asker.n) - cache_most) < 1e-4;
}

/// On a floor and on a wall, 1 x 1; every eighth repeats one of the others.
inline std::vector<Asker> askers(std::uint64_t seed, std::int64_t count) {
  Rng rng(seed);
  std::vector<Asker> all;
  while (static_cast<std::int64_t>(all.size()) < count) {
    const float u = rng.uniform_float();
    const float v = rng.uniform_float();
    Asker next{{u, v, 0}, {0, 0, 1}};
    if (all.size() % 8 == 7) {
      next = all[rng.next_u32() % all.size()];
    } else if (all.size() % 2 == 0) {
      next = {{0, u, v}, {1, 0, 0}};
    }
    const bool decided = std::none_of(all.begin(), all.end(), [&](const Asker& earlier) {
      return too_close_to_call(earlier, next);
    });
    if (decided) all.push_back(next);
  }
  return all;
}

/// A ball whose wall emits 1 and reflects .6, with this many bounces.
constexpr int furnace_bounces = 4;
constexpr double furnace_albedo = 0.6;

}  // namespace lab09_tests
