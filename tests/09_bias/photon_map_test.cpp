// The photon map against a search through all photons. Both round distances in the same way, so
// they must find exactly the same photons.

#include "given/photon_map.h"

#include "random/rng.h"
#include "support/error.h"

#include <catch2/catch_test_macros.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <string>
#include <vector>

using carlo::Rng;
using lab09::Photon;
using lab09::PhotonMap;
using lab09::Vec3;

namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();
constexpr float not_a_number = std::numeric_limits<float>::quiet_NaN();

/// How photons are distributed: in space, on one plane, on one line, in a few points, in a single
/// one.
enum class Lie { space, plane, line, points, point };

/// The number of each photon is stored as its count of Phong surfaces.
std::vector<Photon> photons(Lie lie, int count, Rng& rng) {
  std::vector<Photon> all;
  for (int i = 0; i < count; ++i) {
    const float x = rng.uniform_float();
    const float y = rng.uniform_float();
    const float z = rng.uniform_float();
    Vec3 p{x, y, z};
    if (lie == Lie::plane) p = {x, 0.25f, z};
    if (lie == Lie::line) p = {x, x, 3};
    if (lie == Lie::points) p = glm::floor(3.0f * p);
    if (lie == Lie::point) p = {1, 2, 3};
    all.push_back({p, {0, 0, 1}, {1, 2, 4}, i, 0});
  }
  return all;
}

float distance2(Vec3 a, Vec3 b) {
  const Vec3 d = a - b;
  return d.x * d.x + d.y * d.y + d.z * d.z;
}

std::set<int> by_hand(const std::vector<Photon>& all, Vec3 p, float radius) {
  std::set<int> numbers;
  for (const Photon& photon : all) {
    if (radius > 0 && distance2(photon.p, p) < radius * radius) numbers.insert(photon.phong);
  }
  return numbers;
}

/// Fails if one is found twice, or with a wrong distance.
std::set<int> by_map(const PhotonMap& map, Vec3 p, float radius) {
  std::set<int> numbers;
  map.within(p, radius, [&](const Photon& photon, float d2) {
    CHECK(numbers.insert(photon.phong).second);
    CHECK(d2 == distance2(photon.p, p));
  });
  return numbers;
}

std::vector<float> nearest_by_hand(const std::vector<Photon>& all, Vec3 p, std::size_t k) {
  std::vector<float> distances;
  for (const Photon& photon : all)
    distances.push_back(distance2(photon.p, p));
  std::sort(distances.begin(), distances.end());
  distances.resize(std::min(k, distances.size()));
  return distances;
}

std::vector<float> nearest_by_map(const PhotonMap& map, Vec3 p, int k) {
  std::vector<float> distances;
  std::set<int> numbers;
  for (const Photon* photon : map.nearest(p, k)) {
    CHECK(numbers.insert(photon->phong).second);
    distances.push_back(distance2(photon->p, p));
  }
  return distances;
}

}  // namespace

TEST_CASE("photon map: it finds what a search through all photons finds") {
  Rng rng(1);
  for (const Lie lie : {Lie::space, Lie::plane, Lie::line, Lie::points, Lie::point}) {
    for (const int count : {1, 2, 7, 8, 9, 10, 17, 100, 1000}) {
      const std::vector<Photon> all = photons(lie, count, rng);
      const PhotonMap map(all, 1);
      REQUIRE(map.size() == all.size());
      for (int i = 0; i < 40; ++i) {
        // At photons, where distances are 0 and ties common, and anywhere.
        const float x = rng.uniform_float(), y = rng.uniform_float();
        const Vec3 p = i % 2 == 0 ? all[rng.next_u32() % all.size()].p : Vec3(x, y, 3 * x);
        for (const float radius : {1e-6f, 0.03f, 0.3f, 1.0f, 10.0f, infinity})
          CHECK(by_map(map, p, radius) == by_hand(all, p, radius));
        for (const int k : {1, 2, 9, 50, 999, 1001, std::numeric_limits<int>::max()})
          CHECK(nearest_by_map(map, p, k) == nearest_by_hand(all, p, static_cast<std::size_t>(k)));
      }
    }
  }
}

TEST_CASE("photon map: far from the origin, and large and small") {
  Rng rng(2);
  for (const float scale : {1e-12f, 1.0f, 1e12f}) {
    for (const float shift : {0.0f, 1000.0f}) {
      std::vector<Photon> all = photons(Lie::space, 500, rng);
      for (Photon& photon : all)
        photon.p = scale * (photon.p + Vec3(shift));
      const PhotonMap map(all, 1);
      for (int i = 0; i < 40; ++i) {
        const Vec3 p = all[rng.next_u32() % all.size()].p;
        CHECK(by_map(map, p, 0.2f * scale) == by_hand(all, p, 0.2f * scale));
        CHECK(nearest_by_map(map, p, 20) == nearest_by_hand(all, p, 20));
      }
    }
  }
}

TEST_CASE("photon map: what is no radius, no place or no number of photons finds nothing") {
  Rng rng(3);
  const PhotonMap map(photons(Lie::space, 100, rng), 1);
  for (const float radius : {0.0f, -1.0f, -infinity, not_a_number})
    CHECK(by_map(map, Vec3(0.5f), radius).empty());
  CHECK(by_map(map, Vec3(not_a_number), infinity).empty());
  CHECK(map.nearest(Vec3(not_a_number), 3).empty());
  CHECK(by_map(map, Vec3(infinity), 1).empty());
  for (const int k : {0, -1, std::numeric_limits<int>::min()})
    CHECK(map.nearest(Vec3(0.5f), k).empty());
}

TEST_CASE("photon map: an empty one") {
  for (const PhotonMap& map : {PhotonMap(), PhotonMap({}, 1)}) {
    CHECK(map.size() == 0);
    CHECK(by_map(map, Vec3(0), infinity).empty());
    CHECK(map.nearest(Vec3(0), 5).empty());
  }
}

TEST_CASE("photon map: flux is scaled, and all else is kept") {
  Photon photon{{1, 2, 3}, {0, 1, 0}, {1, 10, 100}, 4, 5};
  const PhotonMap map({photon}, 0.5f);
  const std::vector<const Photon*> found = map.nearest(Vec3(0), 1);
  REQUIRE(found.size() == 1);
  CHECK(found[0]->flux == Vec3(0.5f, 5, 50));
  CHECK(found[0]->p == photon.p);
  CHECK(found[0]->wi == photon.wi);
  CHECK(found[0]->phong == 4);
  CHECK(found[0]->specular == 5);
}

TEST_CASE("photon map: caustic photons have met mirrors or glass alone") {
  CHECK(Photon{{}, {}, {}, 0, 1}.caustic());
  CHECK_FALSE(Photon{{}, {}, {}, 0, 0}.caustic());
  CHECK_FALSE(Photon{{}, {}, {}, 1, 1}.caustic());
  CHECK_FALSE(Photon{{}, {}, {}, 1, 0}.caustic());
}

TEST_CASE("photon map: a place that is not finite is refused by name") {
  for (const float bad : {not_a_number, infinity, -infinity}) {
    try {
      const PhotonMap map({{{0, 0, 0}, {}, {}}, {{0, bad, 0}, {}, {}}}, 1);
      FAIL("it was taken");
    } catch (const carlo::Error& error) {
      CHECK(std::string(error.what()).find("a photon lies nowhere") != std::string::npos);
    }
  }
}
