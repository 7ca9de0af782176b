#include "geometry/analytic.h"
#include "geometry/intersector.h"
#include "hard_case.h"
#include "numeric/robust.h"
#include "random/rng.h"
#include "renderer/warp.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace hard_cases {
namespace {

using carlo::Hit;
using carlo::Scene;
using carlo::Vec3;

Vec3 direction(carlo::Rng& rng) {
  const float z = 1 - 2 * rng.uniform_float(), phi = 2 * carlo::pi_f * rng.uniform_float();
  const float r = carlo::safe_sqrt(1 - z * z);
  return {r * std::cos(phi), r * std::sin(phi), z};
}

Scene spheres(std::initializer_list<carlo::Sphere> list) {
  Scene scene;
  scene.materials.emplace_back();
  for (const carlo::Sphere& sphere : list)
    scene.shapes.push_back({sphere, 0, carlo::Rgb(0)});
  return scene;
}

HardCase far_sphere() {
  const carlo::Sphere sphere{{0, 0, 10'000}, 1};
  const glm::dvec3 center(sphere.center);
  carlo::Rng rng(12);
  double naive = 0, ours = 0;
  for (int i = 0; i < 100'000; ++i) {
    const float r = 0.9f * std::sqrt(rng.uniform_float()),
                phi = 2 * carlo::pi_f * rng.uniform_float();
    const Vec3 d = glm::normalize(Vec3(r * std::cos(phi), r * std::sin(phi), 10'000));
    // The distance of the computed point from the sphere.
    const auto off = [&](double t) {
      return std::abs(glm::length(t * glm::normalize(glm::dvec3(d)) - center) - 1);
    };
    ours = std::max(ours, off(carlo::intersect_sphere(sphere, Vec3(0), d, 0, 1e30f)));
    const float b = glm::dot(sphere.center, d), c = glm::dot(sphere.center, sphere.center) - 1;
    naive = std::max(naive, off(static_cast<double>(b - carlo::safe_sqrt(b * b - c))));
  }
  return {12,
          "unit sphere at 1e4, points off by",
          fmt::format("{:.2g} radii", naive),
          fmt::format("{:.1e}", ours),
          "1e-6",
          ours <= 1e-6};
}

HardCase self_hits() {
  // A sphere of radius S at 100 S: rays leave it outwards.
  int naive = 0, ours = 0, rays = 0;
  for (const float s : {1e-4f, 1.0f, 1e2f, 1e4f, 1e6f}) {
    const Scene scene = spheres({{{100 * s, 0, 0}, s}});
    const carlo::Intersector intersector(scene);
    carlo::Rng rng(13);
    for (int i = 0; i < 20'000; ++i) {
      const Vec3 from = Vec3(100 * s, 0, 0) + 3 * s * direction(rng);
      Hit hit, again;
      const Vec3 d = glm::normalize(Vec3(100 * s, 0, 0) + 0.9f * s * direction(rng) - from);
      if (!intersector.intersect({from, d}, hit)) continue;
      Vec3 out = direction(rng);
      if (glm::dot(out, hit.n) < 0) out = -out;
      ++rays;
      ours +=
          intersector.intersect({carlo::offset_origin(hit.p, hit.p_error, hit.n, out), out}, again)
              ? 1
              : 0;
      naive += intersector.intersect({hit.p, out}, again) && again.t > 1e-4f ? 1 : 0;
    }
  }
  return {13,
          "rays that meet the sphere they leave",
          fmt::format("{:.1f} % (tmin 1e-4)", 100.0 * naive / rays),
          fmt::format("{} of {}", ours, rays),
          "0",
          ours == 0 && rays > 50'000};
}

HardCase thin_gap() {
  // Between spheres of radius 1 and 1.001, and 1e-4 times as large: does a ray that leaves the
  // inner one see the outer?
  int naive = 0, ours = 0, rays = 0;
  for (const float s : {1.0f, 1e-4f}) {
    const Scene scene = spheres({{{0, 0, 0}, s}, {{0, 0, 0}, 1.001f * s, true}});
    const carlo::Intersector intersector(scene);
    carlo::Rng rng(14);
    for (int i = 0; i < 20'000; ++i) {
      const Vec3 outwards = direction(rng);
      Hit hit, next;
      if (!intersector.intersect({1.0005f * s * outwards, -outwards}, hit) || hit.shape != 0)
        continue;
      ++rays;
      const auto misses = [&](Vec3 o) {
        return !intersector.intersect({o, hit.n}, next) || next.shape != 1 ? 1 : 0;
      };
      ours += misses(carlo::offset_origin(hit.p, hit.p_error, hit.n, hit.n));
      naive += misses(hit.p + 1e-4f * hit.n);
    }
  }
  return {14,
          "a gap of 1e-3 radii, not seen",
          fmt::format("{:.0f} % (moved 1e-4)", 100.0 * naive / rays),
          fmt::format("{} of {}", ours, rays),
          "0",
          ours == 0 && rays > 30'000};
}

/// Moeller and Trumbore's test in float.
bool naive_triangle(Vec3 o, Vec3 d, Vec3 a, Vec3 b, Vec3 c) {
  const Vec3 ab = b - a, ac = c - a, p = glm::cross(d, ac);
  const float determinant = glm::dot(ab, p);
  const Vec3 t = o - a;
  const float u = glm::dot(t, p) / determinant;
  const float v = glm::dot(d, glm::cross(t, ab)) / determinant;
  return u >= 0 && v >= 0 && u + v <= 1;
}

HardCase edge_leaks() {
  // A fan of 64 triangles closed around a point; rays aimed at points of the shared edges.
  carlo::Mesh mesh;
  mesh.positions.push_back({0.1f, -0.05f, 1});
  constexpr unsigned n = 64;
  for (unsigned i = 0; i < n; ++i) {
    const float phi = 2 * carlo::pi_f * static_cast<float>(i) / n;
    mesh.positions.push_back({std::cos(phi), std::sin(phi), 1.1f + 0.2f * std::sin(3 * phi)});
    mesh.triangles.push_back({0, 1 + i, 1 + (i + 1) % n});
  }
  Scene scene;
  scene.materials.emplace_back();
  scene.shapes.push_back({mesh, 0, carlo::Rgb(0)});
  const carlo::Intersector intersector(scene);
  carlo::Rng rng(16);
  int naive = 0, ours = 0;
  constexpr int rays = 40'000;
  for (int i = 0; i < rays; ++i) {
    const Vec3 corner = mesh.positions[1 + static_cast<std::size_t>(i) % n];
    const Vec3 target = glm::mix(mesh.positions[0], corner, 0.05f + 0.9f * rng.uniform_float());
    const Vec3 o(0.3f * rng.uniform_float(), 0.3f * rng.uniform_float(), -3);
    const Vec3 d = glm::normalize(target - o);
    Hit hit;
    ours += intersector.intersect({o, d}, hit) ? 0 : 1;
    bool met = false;
    for (const glm::uvec3 t : mesh.triangles)
      met = met ||
            naive_triangle(o, d, mesh.positions[t.x], mesh.positions[t.y], mesh.positions[t.z]);
    naive += met ? 0 : 1;
  }
  return {16,
          "rays through shared edges",
          fmt::format("{:.1f} %", 100.0 * naive / rays),
          fmt::format("{} of {}", ours, rays),
          "0",
          ours == 0};
}

HardCase frames() {
  double naive = 0, ours = 0;
  for (int i = 0; i < 200'000; ++i) {
    const int row = i / 449;
    const float x = 1e-6f * static_cast<float>(i % 449), y = 1e-6f * static_cast<float>(row);
    const Vec3 n = glm::normalize(Vec3(x, y, -1));
    const renderer::Frame frame(n);
    ours = std::max({ours, std::abs(static_cast<double>(glm::length(frame.s)) - 1),
                     std::abs(static_cast<double>(glm::dot(frame.s, frame.t))),
                     std::abs(static_cast<double>(glm::dot(frame.s, n)))});
    if (n.z <= -0.99999994f) continue;  // where Frisvad's division is by zero
    const float a = 1 / (1 + n.z), b = -n.x * n.y * a;
    const Vec3 s(1 - n.x * n.x * a, b, -n.x), t(b, 1 - n.y * n.y * a, -n.y);
    naive = std::max({naive, std::abs(static_cast<double>(glm::length(s)) - 1),
                      std::abs(static_cast<double>(glm::dot(s, t)))});
  }
  return {17,
          "frames near n = -z, off by",
          fmt::format("{:.2g} (Frisvad)", naive),
          fmt::format("{:.1e}", ours),
          "1e-6",
          ours <= 1e-6};
}

HardCase angle_of_equal() {
  carlo::Rng rng(18);
  int naive = 0, ours = 0;
  constexpr int n = 100'000;
  for (int i = 0; i < n; ++i) {
    const Vec3 v = glm::normalize(direction(rng));
    naive += std::isnan(std::acos(glm::dot(v, v))) ? 1 : 0;
    ours += renderer::cos_power(v, v, 1e7f) == 1 ? 0 : 1;
  }
  return {18,
          "the angle of v with itself",
          fmt::format("{:.1f} % NaN", 100.0 * naive / n),
          fmt::format("{} not 0", ours),
          "0",
          ours == 0};
}

HardCase drift() {
  Vec3 naive(0.6f, 0, 0.8f), ours = naive;
  carlo::Rng rng(28);
  for (int i = 0; i < 1'000'000; ++i) {
    const Vec3 n = direction(rng);
    naive = 2 * glm::dot(n, naive) * n - naive;
    ours = glm::normalize(2 * glm::dot(n, ours) * n - ours);
  }
  const double error = std::abs(static_cast<double>(glm::length(ours)) - 1);
  return {28,
          "length of d after 1e6 reflections",
          fmt::format("{:.4f}", glm::length(naive)),
          fmt::format("1 within {:.1e}", error),
          "1 within 1e-6",
          error <= 1e-6};
}

}  // namespace

std::vector<HardCase> geometry_cases() {
  return {far_sphere(), self_hits(), thin_gap(), edge_leaks(), frames(), angle_of_equal(), drift()};
}

}  // namespace hard_cases
