// The cache of records against a search through all of them.

#include "given/records.h"

#include "random/rng.h"

#include <catch2/catch_test_macros.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

using carlo::Rng;
using lab09::Cache;
using lab09::Record;
using lab09::Vec3;

namespace {

constexpr double unlimited = std::numeric_limits<double>::infinity();
constexpr float missing = std::numeric_limits<float>::quiet_NaN();

Vec3 point_of_cube(Rng& rng) {
  const float x = rng.uniform_float();
  const float y = rng.uniform_float();
  const float z = rng.uniform_float();
  return {x, y, z};
}

/// The number of each record is its red; distances from `scale` times 1e-4 to 1.
std::vector<Record> records(int count, float scale, Vec3 at, Rng& rng) {
  std::vector<Record> all;
  for (int i = 0; i < count; ++i) {
    const Vec3 p = at + scale * point_of_cube(rng);
    const double distance = static_cast<double>(scale) * std::pow(10.0, -4 * rng.uniform());
    all.push_back({p, {0, 0, 1}, {static_cast<float>(i), 0, 0}, distance});
  }
  return all;
}

double between(Vec3 a, Vec3 b) {
  return glm::length(glm::dvec3(a) - glm::dvec3(b));
}

Cache cache_of(const std::vector<Record>& all, double most, double nearest, double farthest) {
  Cache cache(most, nearest, farthest);
  for (const Record& record : all)
    cache.add(record);
  return cache;
}

/// Fails if a record that reaches p is missing, if one comes twice or out of order, or if one is
/// far away.
void check_near(const Cache& cache, double most, Vec3 p) {
  std::vector<int> found;
  for (const Record& record : cache.near(p))
    found.push_back(static_cast<int>(record.E.r));
  CHECK(std::is_sorted(found.begin(), found.end(), std::less_equal<>()));
  std::size_t wrong = 0;
  for (const Record& record : cache.records()) {
    const bool there = std::binary_search(found.begin(), found.end(), static_cast<int>(record.E.r));
    const double share = between(record.p, p) / (most * record.distance);
    if (there ? share > 1.001 : share <= 1) ++wrong;
  }
  CHECK(wrong == 0);
}

}  // namespace

TEST_CASE("cache: it finds what a search through all records finds, at every scale and place") {
  Rng rng(1);
  for (const float scale : {1e-4f, 0.01f, 1.0f, 1e3f, 1e6f}) {
    for (const Vec3 at : {Vec3(0), Vec3(-0.5f), Vec3(1000, -3000, 0.5f)}) {
      for (const double most : {0.1, 0.4, 1.0}) {
        const Cache cache = cache_of(records(300, scale, scale * at, rng), most, 0, unlimited);
        for (int i = 0; i < 40; ++i) {
          check_near(cache, most, scale * (at + point_of_cube(rng)));
          check_near(cache, most, cache.records()[rng.next_u32() % 300].p);
        }
      }
    }
  }
}

TEST_CASE("cache: a point at the end of a record's reach is found") {
  for (const float scale : {1e-4f, 1.0f, 1e6f}) {
    for (const Vec3 p : {Vec3(0), Vec3(0.25f), Vec3(3, -7, 0.1f)}) {
      for (const Vec3 d : {Vec3(1, 0, 0), Vec3(0, -1, 0), Vec3(0, 0, 1)}) {
        Cache cache(0.5, 0, unlimited);
        cache.add({scale * p, {0, 0, 1}, {}, static_cast<double>(scale)});
        CHECK(cache.near(scale * (p + 0.499f * d)).size() == 1);
        CHECK(cache.near(scale * (p + 0.501f * d)).empty());
      }
    }
  }
}

TEST_CASE("cache: distances are put between the nearest and the farthest") {
  const Cache cache =
      cache_of({{{}, {}, {}, 1e-3}, {{}, {}, {}, 0.5}, {{}, {}, {}, 7}, {{}, {}, {}, unlimited}},
               0.5, 0.1, 2);
  std::vector<double> distances;
  for (const Record& record : cache.records())
    distances.push_back(record.distance);
  CHECK(distances == std::vector<double>{0.1, 0.5, 2, 2});
  CHECK(cache.near({0.04f, 0, 0}).size() == 4);
  CHECK(cache.near({0.2f, 0, 0}).size() == 3);
  CHECK(cache.near({0.9f, 0, 0}).size() == 2);
  CHECK(cache.near({1.1f, 0, 0}).empty());
}

TEST_CASE("cache: a record of infinite distance serves everywhere, one of none at its place") {
  const Cache cache = cache_of(
      {{{1, 2, 3}, {}, {0, 0, 0}, unlimited}, {{1, 2, 3}, {}, {1, 0, 0}, 0}}, 0.3, 0, unlimited);
  CHECK(cache.near({1, 2, 3}).size() == 2);
  CHECK(cache.near({1e30f, -2, 3}).size() == 1);
}

TEST_CASE("cache: numbers that are none, and far places, find nothing and hold nothing up") {
  Cache cache(0.3, 0, unlimited);
  CHECK(cache.near({0, 0, 0}).empty());
  cache.add({{missing, 0, 0}, {}, {}, 1});
  cache.add({{0, 0, 0}, {}, {}, std::numeric_limits<double>::quiet_NaN()});
  cache.add({{1e38f, 0, 0}, {}, {}, 1e-6});
  cache.add({{-1e38f, 0, 0}, {}, {}, 1e38});
  CHECK(cache.records().size() == 4);
  CHECK(cache.near({0, 0, 0}).empty());
  CHECK(cache.near({missing, 0, 0}).empty());
  CHECK(cache.near({INFINITY, 0, 0}).empty());
  CHECK(cache.near({1e38f, 0, 0}).size() == 1);
}
