#include "geometry/analytic.h"
#include "geometry/intersector.h"
#include "geometry/mesh_tracer.h"
#include "numeric/robust.h"
#include "random/rng.h"

#include <catch2/catch_test_macros.hpp>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace {

using namespace carlo;
using Vec3d = glm::dvec3;

Scene scene_of(std::vector<Shape> shapes) {
  Scene scene;
  scene.materials.emplace_back();
  scene.shapes = std::move(shapes);
  return scene;
}

Vec3 random_direction(Rng& rng) {
  for (;;) {
    const float x = 2 * rng.uniform_float() - 1;
    const float y = 2 * rng.uniform_float() - 1;
    const float z = 2 * rng.uniform_float() - 1;
    const float r2 = x * x + y * y + z * z;
    if (r2 > 1e-3f && r2 < 1) return Vec3(x, y, z) / std::sqrt(r2);
  }
}

TEST_CASE("Hits on every kind of shape: distance, point, normal, shape and primitive") {
  const Scene scene =
      scene_of({{Parallelogram{{-1, -1, 0}, {2, 0, 0}, {0, 2, 0}}},
                {Sphere{{10, 0, 0}, 2}},
                {Disk{{20, 0, 0}, {0, 0, 1}, 1}},
                {Mesh{{{30, 0, 0}, {31, 0, 0}, {30, 1, 0}, {31, 1, 0}}, {{0, 1, 2}, {1, 3, 2}}}}});
  const Intersector geometry(scene);
  const auto shoot = [&](float x, float y) {
    Hit hit;
    REQUIRE(geometry.intersect({{x, y, 5}, {0, 0, -1}}, hit));
    return hit;
  };
  const Hit quad = shoot(0.25f, -0.5f), sphere = shoot(10, 0), disk = shoot(20.5f, 0.5f),
            triangle = shoot(30.75f, 0.5f);
  CHECK((quad.shape == 0 && quad.t == 5 && quad.n == Vec3(0, 0, 1)));
  CHECK(glm::length(quad.p - Vec3(0.25f, -0.5f, 0)) <= 1e-6f);
  CHECK((sphere.shape == 1 && sphere.t == 3 && sphere.n == Vec3(0, 0, 1)));
  CHECK((disk.shape == 2 && disk.t == 5 && disk.n == Vec3(0, 0, 1)));
  CHECK((triangle.shape == 3 && triangle.primitive == 1 && triangle.n == Vec3(0, 0, 1)));
  Hit none;
  CHECK_FALSE(geometry.intersect({{20.9f, 0.9f, 5}, {0, 0, -1}}, none));
  CHECK_FALSE(geometry.intersect({{0, 0, 5}, {0, 0, 1}}, none));
}

TEST_CASE("Occlusion respects the ray's end") {
  const Scene scene = scene_of({{Sphere{{0, 0, 0}, 1}}, {Disk{{0, 0, -5}, {0, 0, 1}, 1}}});
  const Intersector geometry(scene);
  CHECK(geometry.occluded({{0, 0, 3}, {0, 0, -1}}, 2.01f));
  CHECK_FALSE(geometry.occluded({{0, 0, 3}, {0, 0, -1}}, 1.99f));
  CHECK_FALSE(geometry.occluded({{0, 0, -2}, {0, 0, -1}}, 2.99f));
}

TEST_CASE("A sphere of radius 1 seen from 1e4 away is hit where it should be") {
  // Hard case 12: the textbook quadratic in float misses 26 % of the hits and errs by 5.4 radii.
  Rng rng(1);
  const Sphere sphere{{0, 0, 0}, 1};
  int missed = 0;
  double worst = 0;
  for (int i = 0; i < 20000; ++i) {
    const Vec3 origin = 1e4f * random_direction(rng);
    const Vec3 target = 0.98f * rng.uniform_float() * random_direction(rng);
    const Vec3 d = glm::normalize(target - origin);
    // The float direction itself may miss the sphere; compare with an independent double
    // computation.
    const Vec3d dd = glm::normalize(Vec3d(d)), o(origin);
    const double b = glm::dot(o, dd), distance = glm::length(o - b * dd);
    if (distance > 0.999) continue;
    const double t = intersect_sphere(sphere, origin, d, 0, std::numeric_limits<float>::infinity());
    if (!(t > 0)) {
      ++missed;
      continue;
    }
    const SurfacePoint point = sphere_point(sphere, origin, d, t);
    worst = std::max(worst, std::abs(glm::length(Vec3d(point.p)) - 1));
  }
  CHECK(missed == 0);
  CHECK(worst <= 1e-6);
}

/// Counts how often a ray that leaves a surface point into its outer hemisphere meets the same
/// shape.
struct SelfHits {
  int tried = 0, hits = 0;
};

SelfHits self_hits(const Scene& scene, Vec3 center, float size, std::uint64_t seed) {
  const Intersector geometry(scene);
  Rng rng(seed);
  SelfHits result;
  while (result.tried < 5000) {
    const Vec3 from = center + 4 * size * random_direction(rng);
    const Vec3 to = center + 0.8f * size * rng.uniform_float() * random_direction(rng);
    Hit hit, again;
    if (!geometry.intersect({from, glm::normalize(to - from)}, hit)) continue;
    const Vec3 side = glm::dot(hit.n, from - hit.p) > 0 ? hit.n : -hit.n;
    Vec3 d = random_direction(rng);
    if (glm::dot(d, side) < 0) d = -d;
    ++result.tried;
    const Ray next{offset_origin(hit.p, hit.p_error, hit.n, d), d};
    if (geometry.intersect(next, again) && again.shape == hit.shape) ++result.hits;
  }
  return result;
}

TEST_CASE("No convex shape is hit by rays that leave it, at any scale and place") {
  // Hard case 13: with a fixed tmin of 1e-4, spheres of size S at 100 S are hit again by 34 to 48 %
  // of the rays for S >= 1e2.
  for (const float s : {1e-4f, 1e-2f, 1.0f, 1e2f, 1e4f, 1e6f}) {
    for (const float place : {0.0f, 1.0f, 100.0f}) {
      const Vec3 c = s * place * Vec3(1, 0.7f, -0.4f);
      const Vec3 u = s * Vec3(1, 0.3f, 0.2f), v = s * Vec3(-0.3f, 1, 0.1f);
      CHECK(self_hits(scene_of({{Sphere{c, s}}}), c, s, 1).hits == 0);
      CHECK(self_hits(scene_of({{Disk{c, glm::normalize(Vec3(1, 2, 3)), s}}}), c, s, 2).hits == 0);
      CHECK(self_hits(scene_of({{Parallelogram{c - u - v, 2.0f * u, 2.0f * v}}}), c, s, 3).hits ==
            0);
      CHECK(self_hits(scene_of({{Mesh{{c + u, c + v, c - u - v}, {{0, 1, 2}}}}}), c, s, 4).hits ==
            0);
    }
  }
}

TEST_CASE("A gap of 1e-3 radii between nested spheres is still seen, at any scale") {
  // Hard case 14: offsets or a tmin of fixed size skip the gap.
  for (const float s : {1e-4f, 1e-2f, 1.0f, 1e2f, 1e4f, 1e6f}) {
    const Vec3 c = s * Vec3(3, -2, 1);
    const Scene scene = scene_of({{Sphere{c, s}}, {Sphere{c, s * (1 - 1e-3f)}}});
    const Intersector geometry(scene);
    Rng rng(5);
    int lost = 0;
    for (int i = 0; i < 5000; ++i) {
      const Vec3 n = random_direction(rng);
      Hit outer, inner;
      REQUIRE(geometry.intersect({c + 3 * s * n, -n}, outer));
      const Ray inwards{offset_origin(outer.p, outer.p_error, outer.n, -n), -n};
      if (!geometry.intersect(inwards, inner) || inner.shape != 1) ++lost;
    }
    CHECK(lost == 0);
  }
}

TEST_CASE("No ray passes between two triangles or parallelograms that share an edge") {
  // Hard case 16: rays aimed at shared edges leak through Moeller and Trumbore's test in 8.5 % of
  // cases.
  Rng rng(7);
  const Vec3 a(-1.3f, -1.1f, 0.2f), b(1.7f, -0.9f, -0.1f), c(1.2f, 1.6f, 0.3f),
      d(-1.5f, 1.4f, 0.1f);
  const Scene scene = scene_of({{Mesh{{a, b, c, d}, {{0, 1, 2}, {0, 2, 3}}}}});
  const Scene quads = scene_of({{Parallelogram{{-1, -1, 0}, {1, 0, 0}, {0, 2, 0}}},
                                {Parallelogram{{0, -1, 0}, {1, 0, 0}, {0, 2, 0}}}});
  const Intersector triangles(scene), floor(quads);
  int leaks = 0;
  for (int i = 0; i < 40000; ++i) {
    const float t = 0.01f + 0.98f * rng.uniform_float();
    const Vec3 from = 3.0f * random_direction(rng) + Vec3(0, 0, 4);
    Hit hit;
    if (!triangles.intersect({from, glm::normalize(glm::mix(a, c, t) - from)}, hit)) ++leaks;
    const Vec3 seam(0, 1.98f * rng.uniform_float() - 0.99f, 0);
    if (!floor.intersect({from, glm::normalize(seam - from)}, hit)) ++leaks;
  }
  CHECK(leaks == 0);
}

// Two lights back to back had half of their light.
TEST_CASE("A rectangle on the back of a light does not hide it") {
  Rng rng(5);
  const auto any = [&] {
    return Vec3(rng.uniform_float(), rng.uniform_float(), rng.uniform_float()) - Vec3(.5f);
  };
  int hidden = 0;
  for (int i = 0; i < 1000; ++i) {
    const Vec3 corner = 3.0f * any(), u = any(), v = any();
    const Scene scene = scene_of(
        {{Sphere{{50, 0, 0}, 1}}, {Parallelogram{corner, u, v}}, {Parallelogram{corner, v, u}}});
    const Intersector intersector(scene);
    const Vec3 light = corner + rng.uniform_float() * u + rng.uniform_float() * v;
    const Vec3 o = light + 4.0f * any();
    const float length = glm::length(light - o);
    const Ray ray{o, (light - o) / length};
    for (const std::uint32_t aimed_at : {1u, 2u})
      hidden += intersector.occluded(ray, length, aimed_at) ? 1 : 0;
    CHECK(intersector.occluded(ray, 1.01f * length));
  }
  CHECK(hidden == 0);
}

// Embree 3.13.5 traced all rays of a packet on machines without AVX-512, and Debian's ended the
// program at the first that is not finite.
TEST_CASE("Only the wanted rays of a packet are traced, with each instruction set of Embree's") {
  const Mesh mesh{{{-2, -2, 0}, {2, -2, 0}, {0, 2, 0}}, {{0, 1, 2}}};
  std::vector<const char*> settings = {nullptr};
#ifdef __x86_64__
  settings.push_back("isa=sse4.2");
  if (__builtin_cpu_supports("avx2")) settings.push_back("isa=avx2");
#endif
  for (const char* const embree : settings) {
    INFO((embree == nullptr ? "default" : embree));
    const carlo::MeshTracer tracer({&mesh}, embree);
    for (const std::uint32_t wanted : {0u, 1u, 0xFFu, 0x8421u, 0xFFFFu}) {
      carlo::MeshRays rays;
      for (std::size_t i = 0; i < carlo::MeshRays::most; ++i) {
        const bool good = (wanted >> i & 1) != 0;
        const float x = good ? .04f * static_cast<float>(i) : std::nanf("");
        rays.ox[i] = rays.oy[i] = x, rays.oz[i] = i % 3 == 0 ? -1.0f : 1.0f;
        rays.dx[i] = rays.dy[i] = 0, rays.dz[i] = -1;
        rays.t[i] = good ? 5 : std::numeric_limits<float>::infinity();
      }
      const std::uint32_t facing = wanted & ~0x9249u;  // all but each third
      CHECK(tracer.occluded(rays, wanted) == facing);
      CHECK(tracer.intersect(rays, wanted) == facing);
      for (std::size_t i = 0; i < carlo::MeshRays::most; ++i)
        CHECK(((facing >> i & 1) == 0 || rays.t[i] == 1));
    }
  }
}

TEST_CASE("An offset moves the origin to the asked side and by no more than a few ulps") {
  Rng rng(11);
  for (int i = 0; i < 10000; ++i) {
    const Vec3 n = random_direction(rng), d = random_direction(rng),
               p = 7.0f * random_direction(rng);
    const Vec3 error = rounding_bound(3) * glm::abs(p);
    const Vec3 o = offset_origin(p, error, n, d);
    const double along = glm::dot(Vec3d(o) - Vec3d(p), Vec3d(n));
    CHECK(along * static_cast<double>(glm::dot(d, n)) >= 0);
    CHECK(std::abs(along) >= static_cast<double>(glm::dot(glm::abs(n), error)));
    CHECK(glm::length(Vec3d(o) - Vec3d(p)) <= 1e-5);
  }
}

}  // namespace
