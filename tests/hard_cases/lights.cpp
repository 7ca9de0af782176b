#include "renderer/lights.h"

#include "geometry/intersector.h"
#include "geometry/shadow_ray.h"
#include "hard_case.h"
#include "numeric/robust.h"
#include "random/rng.h"
#include "renderer/spherical_rectangle.h"
#include "scene/scene.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace hard_cases {
namespace {

using carlo::pi;
using carlo::Rgb;
using carlo::Scene;
using carlo::Vec3;

Scene lit_by(carlo::Shape light) {
  Scene scene;
  scene.materials.emplace_back();
  light.radiance = Rgb(1);
  scene.shapes.push_back(std::move(light));
  return scene;
}

struct Spread {
  double mean, relative_sd;
};

/// For one estimate of the irradiance of a floor with normal +z at `from`.
Spread irradiance(const Scene& scene, Vec3 from, int n) {
  const renderer::Lights lights(scene);
  carlo::Rng rng(6);
  double sum = 0, squares = 0;
  for (int i = 0; i < n; ++i) {
    const float u_light = rng.uniform_float();
    const float u = rng.uniform_float();
    const float v = rng.uniform_float();
    const auto point = lights.sample({{from}, {0, 0, 1}}, u_light, {u, v});
    if (!point) continue;
    const double e = static_cast<double>(std::max(0.0f, glm::normalize(point->p - from).z)) /
                     static_cast<double>(point->pdf);
    sum += e;
    squares += e * e;
  }
  const double mean = sum / n;
  return {mean, std::sqrt(std::max(0.0, squares / n - mean * mean)) / mean};
}

HardCase tiny_sphere() {
  const float ratio = 1e-4f;
  const Scene scene = lit_by({carlo::Sphere{{0, 0, 1}, ratio}});
  const renderer::Lights lights(scene);
  const auto point = lights.sample({{}, {0, 0, 1}}, 0.5f, {0.3f, 0.6f});
  const double ours = point ? 1 / static_cast<double>(point->pdf) : 0;
  const float cosine = std::sqrt(1 - ratio * ratio);
  const auto naive = static_cast<double>(2 * carlo::pi_f * (1 - cosine));
  const double exact = pi * 1e-8;
  return {6,
          "solid angle of a sphere, R/d = 1e-4",
          fmt::format("{:.3g}", naive),
          fmt::format("{:.4g}", ours),
          "3.142e-08 within 1e-5",
          std::abs(ours / exact - 1) <= 1e-5};
}

HardCase inside_sphere() {
  const Scene scene = lit_by({carlo::Sphere{{0, 0, 0}, 1, true}});
  const double ours = irradiance(scene, {0.3f, 0.2f, -0.6f}, 400'000).mean;
  const float sin2 = 1 / (0.3f * 0.3f + 0.2f * 0.2f + 0.6f * 0.6f);
  return {7,
          "irradiance within a sphere light",
          fmt::format("{:g} (cone)", std::sqrt(1 - sin2)),
          fmt::format("{:.3f}", ours),
          "pi within 1 %",
          std::abs(ours / pi - 1) <= 0.01};
}

HardCase near_sphere() {
  const float h = 1.01f;
  const Spread ours = irradiance(lit_by({carlo::Sphere{{0, 0, h}, 1}}), {0, 0, 0}, 100'000);
  carlo::Rng rng(8);
  double sum = 0, squares = 0;
  constexpr int n = 4'000'000;
  for (int i = 0; i < n; ++i) {
    const double z = 1 - 2 * rng.uniform(), r = std::sqrt(1 - z * z);
    const double height = static_cast<double>(h) + z, d2 = r * r + height * height;
    const double cos_light = -(r * r + z * height) / std::sqrt(d2), cosine = height / std::sqrt(d2);
    const double e = cos_light > 0 ? 4 * pi * cosine * cos_light / d2 : 0;
    sum += e;
    squares += e * e;
  }
  const double mean = sum / n;
  return {8,
          "sd of light from a sphere at d/R = 1.01",
          fmt::format("{:.0f} (by area)", std::sqrt(squares / n - mean * mean) / mean),
          fmt::format("{:.3f}", ours.relative_sd),
          "below 0.5",
          ours.relative_sd <= 0.5};
}

HardCase touching_rectangle() {
  // A wall that stands on the floor, seen from 1/1000 in front of it.
  const carlo::Parallelogram wall{{0.001f, -0.5f, 0}, {0, 1, 0}, {0, 0, 1}};
  carlo::Parallelogram facing = wall;
  std::swap(facing.u, facing.v);
  const Spread ours = irradiance(lit_by({facing}), {0, 0, 0}, 100'000);
  carlo::Rng rng(9);
  double sum = 0, squares = 0;
  constexpr int n = 1'000'000;
  for (int i = 0; i < n; ++i) {
    const double y = rng.uniform() - 0.5, z = rng.uniform(), d2 = 1e-6 + y * y + z * z;
    const double e = z * 1e-3 / (d2 * d2);
    sum += e;
    squares += e * e;
  }
  const double mean = sum / n;
  return {9,
          "sd of light from a wall 1/1000 away",
          fmt::format("{:.0f} (by area)", std::sqrt(squares / n - mean * mean) / mean),
          fmt::format("{:.3f}", ours.relative_sd),
          "below 1",
          ours.relative_sd <= 1 && ours.mean > 1};
}

HardCase small_solid_angle() {
  const carlo::Parallelogram patch{{-0.0005f, -0.0005f, 1}, {0.001f, 0, 0}, {0, 0.001f, 0}};
  const double ours =
      renderer::SphericalRectangle(renderer::RectangleFrame(patch), {0, 0, 0}).solid_angle();
  // Girard's sum of angles, in float: four right angles and a little.
  const auto n =
      glm::normalize(glm::cross(Vec3(-0.0005f, -0.0005f, 1), Vec3(0.0005f, -0.0005f, 1)));
  const auto m = glm::normalize(glm::cross(Vec3(0.0005f, -0.0005f, 1), Vec3(0.0005f, 0.0005f, 1)));
  const float naive = 4 * std::acos(-glm::dot(n, m)) - 2 * carlo::pi_f;
  return {10,
          "solid angle of a square of side 1e-3",
          fmt::format("{:.3g}", naive),
          fmt::format("{:.6g}", ours),
          "1e-06 within 1e-5",
          std::abs(ours / 1e-6 - 1) <= 1e-5};
}

HardCase small_polygon() {
  // Lambert's formula for a square of side .01 at height 1, in float: edges by acos or by atan2.
  const float a = 0.005f;
  const Vec3 corners[] = {{-a, -a, 1}, {a, -a, 1}, {a, a, 1}, {-a, a, 1}};
  float by_acos = 0;
  double by_atan = 0;
  for (int i = 0; i < 4; ++i) {
    const Vec3 p = glm::normalize(corners[i]), q = glm::normalize(corners[(i + 1) % 4]);
    by_acos += 0.5f * std::acos(glm::dot(p, q)) * glm::normalize(glm::cross(p, q)).z;
    const glm::dvec3 c = glm::cross(glm::dvec3(corners[i]), glm::dvec3(corners[(i + 1) % 4]));
    by_atan += 0.5 *
               std::atan2(glm::length(c),
                          glm::dot(glm::dvec3(corners[i]), glm::dvec3(corners[(i + 1) % 4]))) *
               c.z / glm::length(c);
  }
  const Spread ours =
      irradiance(lit_by({carlo::Parallelogram{{-a, a, 1}, {2 * a, 0, 0}, {0, -2 * a, 0}}}),
                 {0, 0, 0}, 100'000);
  return {11,
          "irradiance of a square of side .01",
          fmt::format("{:.3g} (acos)", std::abs(by_acos)),
          fmt::format("{:.5g}", ours.mean),
          fmt::format("{:.5g} within 1e-4", std::abs(by_atan)),
          std::abs(ours.mean / std::abs(by_atan) - 1) <= 1e-4};
}

HardCase shadow_ends() {
  // A light a million away: the ray must not meet the light itself.
  Scene scene = lit_by({carlo::Parallelogram{{-3e5f, 3e5f, 1e6f}, {6e5f, 0, 0}, {0, -6e5f, 0}}});
  const carlo::Intersector intersector(scene);
  const renderer::Lights lights(scene);
  carlo::Rng rng(15);
  int naive = 0, ours = 0;
  constexpr int n = 100'000;
  for (int i = 0; i < n; ++i) {
    const Vec3 o(1000 * rng.uniform_float(), 1000 * rng.uniform_float(), rng.uniform_float());
    const float u = rng.uniform_float();
    const float v = rng.uniform_float();
    const auto point = lights.sample({{o}, {0, 0, 1}}, 0.5f, {u, v});
    if (!point) continue;
    const carlo::ShadowRay shadow = carlo::shadow_ray(o, point->p, point->p_error, point->n);
    ours += intersector.occluded(shadow.ray, shadow.length) ? 1 : 0;
    const float distance = glm::length(point->p - o);
    naive += intersector.occluded({o, (point->p - o) / distance}, distance - 1e-3f) ? 1 : 0;
  }
  return {15,
          "light a million away, shaded by itself",
          fmt::format("{:.1f} % of rays", 100.0 * naive / n),
          fmt::format("{} rays of {}", ours, n),
          "0",
          ours == 0};
}

}  // namespace

std::vector<HardCase> light_cases() {
  return {tiny_sphere(),       inside_sphere(), near_sphere(), touching_rectangle(),
          small_solid_angle(), small_polygon(), shadow_ends()};
}

}  // namespace hard_cases
