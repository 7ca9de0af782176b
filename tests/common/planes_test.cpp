// Parallelograms that share a plane, compared with a search of all pairs by the definition.

#include "geometry/planes.h"

#include "numeric/robust.h"
#include "random/rng.h"

#include <catch2/catch_test_macros.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

namespace {

using carlo::Parallelogram;
using carlo::Rng;
using carlo::Vec3;
using glm::dvec3;

Vec3 in_cube(Rng& rng) {
  const double x = rng.uniform(), y = rng.uniform();
  return Vec3(2.0 * dvec3(x, y, rng.uniform()) - 1.0);
}

/// The largest distance of b's corners from a's plane, if rounding explains all of them.
std::optional<double> distance_from(const Parallelogram& a, const Parallelogram& b) {
  const dvec3 n = glm::normalize(glm::cross(dvec3(a.u), dvec3(a.v)));
  double largest = 0;
  for (const double s : {0.0, 1.0}) {
    for (const double t : {0.0, 1.0}) {
      const dvec3 p = dvec3(b.origin) + s * dvec3(b.u) + t * dvec3(b.v), size = glm::abs(p);
      const double distance = std::abs(glm::dot(n, p - dvec3(a.origin)));
      const double allowed = carlo::rounding_bound(4) *
                             (size.x + size.y + size.z + std::abs(glm::dot(n, dvec3(a.origin))));
      if (!(distance <= allowed)) return std::nullopt;
      largest = std::max(largest, distance);
    }
  }
  return largest;
}

std::vector<carlo::Planes::Entry> by_pairs(const std::vector<Parallelogram>& quads) {
  std::vector<carlo::Planes::Entry> entries;
  for (std::uint32_t i = 0; i < quads.size(); ++i) {
    carlo::Planes::Entry entry{i, 0};
    for (std::uint32_t k = 0; k < i; ++k) {
      if (entries[k].first != k) continue;
      const auto there = distance_from(quads[k], quads[i]),
                 back = distance_from(quads[i], quads[k]);
      if (!there || !back) continue;
      entry = {k, std::max(*there, *back)};
      break;
    }
    entries.push_back(entry);
  }
  return entries;
}

/// Parallelograms in planes that several share, slanted or along axes, of sizes over six orders of
/// magnitude, up to `far` from the origin; some are moved by a few roundings.
std::vector<Parallelogram> some_quads(std::uint64_t seed, float far) {
  Rng rng(seed, 0);
  std::vector<Parallelogram> quads;
  for (int plane = 0; plane < 12; ++plane) {
    const Vec3 o = far * in_cube(rng);
    const Vec3 a = plane % 3 == 0 ? Vec3(1, 0, 0) : glm::normalize(in_cube(rng));
    const Vec3 b = plane % 3 == 0 ? Vec3(0, 0, 1) : glm::normalize(glm::cross(a, in_cube(rng)));
    for (int i = 0; i < 20; ++i) {
      const auto size = static_cast<float>(std::pow(10.0, 6 * rng.uniform() - 6));
      const auto s = static_cast<float>(rng.uniform()), t = static_cast<float>(rng.uniform());
      const auto turn = static_cast<float>(6 * rng.uniform());
      const Vec3 u = std::cos(turn) * a + std::sin(turn) * b;
      const Vec3 v = std::cos(turn) * b - std::sin(turn) * a;
      Vec3 corner = o + s * a + t * b;
      if (i % 5 == 0) corner.y *= 1 + static_cast<float>(i) * 1e-7f;
      quads.push_back({corner, size * u, size * v});
    }
  }
  return quads;
}

}  // namespace

TEST_CASE("Parallelograms of one plane are found as by a search of all pairs") {
  for (const float far : {0.0f, 1.0f, 1e3f, 1e6f}) {
    for (std::uint64_t seed = 0; seed < 10; ++seed) {
      const std::vector<Parallelogram> quads = some_quads(seed, far);
      const auto expected = by_pairs(quads);
      const auto found = carlo::find_planes(quads).of;
      std::size_t shared = 0, wrong = 0;
      for (std::uint32_t i = 0; i < quads.size(); ++i) {
        shared += expected[i].first != i;
        wrong += found[i].first != expected[i].first || found[i].gap != expected[i].gap;
      }
      INFO("up to " << far << " from the origin, seed " << seed);
      CHECK(wrong == 0);
      CHECK(shared > quads.size() / 4);
    }
  }
}

TEST_CASE("A parallelogram without area shares no plane") {
  const Parallelogram flat{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, line{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
  const auto of = carlo::find_planes(std::array{line, flat, line, flat}).of;
  CHECK(of[0].first == 0);
  CHECK(of[1].first == 1);
  CHECK(of[2].first == 2);
  CHECK(of[3].first == 1);
}
