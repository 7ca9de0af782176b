// Points on an emitting mesh: the densities from sample() and density() agree, and match the
// points.
//
// Error rates: chi-square at alpha = 1e-4, 1e5 points for each of 8 places; another seed would fail
// with probability 8e-4. Power: a triangle's share of .05 that is off by a tenth is detected with
// probability above .999.

#include "renderer/mesh_light.h"

#include "random/rng.h"
#include "stats/goodness.h"

#include <catch2/catch_test_macros.hpp>

#include <cmath>
#include <cstdint>
#include <vector>

namespace {

using namespace carlo;
using renderer::MeshLight;

/// A bowl of triangles of many sizes, open to +z, which emits inwards.
Mesh bowl() {
  constexpr std::uint32_t rings = 6, sectors = 12;
  Mesh mesh;
  for (std::uint32_t ring = 0; ring <= rings; ++ring) {
    const float r = static_cast<float>(ring * ring) / (rings * rings);
    for (std::uint32_t k = 0; k < sectors; ++k) {
      const float phi = 6.2831853f * static_cast<float>(k) / sectors;
      mesh.positions.push_back({r * std::cos(phi), r * std::sin(phi), r * r});
    }
  }
  for (std::uint32_t ring = 0; ring < rings; ++ring) {
    for (std::uint32_t k = 0; k < sectors; ++k) {
      const std::uint32_t next = (k + 1) % sectors, a = ring * sectors, b = a + sectors;
      // The innermost ring is a point: one of the two triangles would have no area.
      if (ring > 0) mesh.triangles.push_back({a + k, b + next, a + next});
      mesh.triangles.push_back({a + k, b + k, b + next});
    }
  }
  return mesh;
}

TEST_CASE("A mesh's points have the density that is told") {
  const Mesh mesh = bowl();
  const MeshLight light(mesh);
  Rng rng(81);
  constexpr int draws = 100000;
  const Vec3 places[] = {{0, 0, .2f},    {.9f, 0, .9f},  {0, 0, 50},      {3, 1, 2},
                         {-.2f, .1f, 9}, {0, .5f, .26f}, {1e4f, 0, 1e4f}, {.3f, .3f, .18f}};
  for (const Vec3 p : places) {
    const Vec3 n = glm::normalize(Vec3(.1f, .2f, 0) - p);
    std::vector<double> counts(mesh.triangles.size() + 1), expected(counts.size());
    double sum = 0;
    for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i)
      sum += expected[i] = light.density(p, n, i) * renderer::triangle_area(mesh, i);
    expected.back() = std::max(0.0, 1 - sum);
    CHECK(sum <= 1 + 1e-9);
    for (int i = 0; i < draws; ++i) {
      const float x = rng.uniform_float();
      const MeshLight::Sample sample = light.sample(p, n, {x, rng.uniform_float()});
      if (!(sample.density > 0)) {
        ++counts.back();
        continue;
      }
      ++counts[sample.triangle];
      CHECK(std::abs(sample.density / light.density(p, n, sample.triangle) - 1) <= 1e-9);
    }
    for (double& e : expected)
      e *= draws;
    CHECK(pooled_goodness(counts, expected).p >= 1e-4);
  }
}

TEST_CASE("A mesh's points for light paths are uniform by area, and in their triangles") {
  const Mesh mesh = bowl();
  const MeshLight light(mesh);
  Rng rng(82);
  constexpr int draws = 100000;
  std::vector<double> counts(mesh.triangles.size()), expected(counts.size());
  double area = 0;
  for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
    expected[i] = draws * renderer::triangle_area(mesh, i) / light.area();
    area += renderer::triangle_area(mesh, i);
  }
  CHECK(std::abs(area / light.area() - 1) <= 1e-12);
  for (int i = 0; i < draws; ++i) {
    const float x = rng.uniform_float();
    const MeshLight::Sample sample = light.sample({x, rng.uniform_float()});
    ++counts[sample.triangle];
    CHECK(std::abs(sample.density * light.area() - 1) <= 1e-12);
    const Vec3 a = mesh.positions[mesh.triangles[sample.triangle].x];
    CHECK(std::abs(glm::dot(sample.point.p - a, sample.point.n)) <= 1e-6f);
  }
  CHECK(pooled_goodness(counts, expected).p >= 1e-4);
}

}  // namespace
