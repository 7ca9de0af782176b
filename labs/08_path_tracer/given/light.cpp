#include "cli/error.h"
#include "given/world.h"
#include "hemisphere.h"
#include "numeric/robust.h"
#include "scene/match.h"

#include <algorithm>
#include <cmath>

namespace lab08 {
namespace {

using carlo::Disk;
using carlo::Mesh;
using carlo::Parallelogram;
using carlo::Sdf;
using carlo::Sphere;

using Vec3d = glm::dvec3;

/// Of edges u and v, in double: squares of their product may be beyond float.
float area_between(Vec3 u, Vec3 v) {
  return static_cast<float>(glm::length(glm::cross(Vec3d(u), Vec3d(v))));
}
Vec3 normal_of(Vec3 u, Vec3 v) {
  return Vec3(glm::normalize(glm::cross(Vec3d(u), Vec3d(v))));
}

float triangle_area(const Mesh& mesh, glm::uvec3 corner) {
  const Vec3 a = mesh.positions[corner.x];
  return 0.5f * area_between(mesh.positions[corner.y] - a, mesh.positions[corner.z] - a);
}

std::vector<double> running_areas(const Mesh& mesh) {
  std::vector<double> areas;
  double sum = 0;
  for (const glm::uvec3 corner : mesh.triangles) {
    sum += static_cast<double>(triangle_area(mesh, corner));
    areas.push_back(sum);
  }
  return areas;
}

LightPoint point_on(const Parallelogram& s, Vec2 u) {
  return {s.origin + u.x * s.u + u.y * s.v, normal_of(s.u, s.v), Rgb(0),
          carlo::rounding_bound(12) * (glm::abs(s.origin) + glm::abs(s.u) + glm::abs(s.v))};
}

LightPoint point_on(const Sphere& s, Vec2 u) {
  const float z = 1 - 2 * u.x, r = carlo::safe_sqrt(1 - z * z), phi = 2 * carlo::pi_f * u.y;
  const Vec3 n(r * std::cos(phi), r * std::sin(phi), z);
  return {s.center + s.radius * n, s.flipped ? -n : n, Rgb(0),
          carlo::rounding_bound(8) * (glm::abs(s.center) + Vec3(s.radius))};
}

LightPoint point_on(const Disk& s, Vec2 u) {
  const float r = s.radius * std::sqrt(u.x), phi = 2 * carlo::pi_f * u.y;
  const lab07::Frame frame(s.normal);
  return {s.center + frame.to_world({r * std::cos(phi), r * std::sin(phi), 0}), s.normal, Rgb(0),
          carlo::rounding_bound(12) * (glm::abs(s.center) + Vec3(s.radius))};
}

LightPoint point_on(const Mesh& mesh, std::span<const double> areas, Vec2 u) {
  const double place = static_cast<double>(u.x) * areas.back();
  const auto found = std::upper_bound(areas.begin(), areas.end() - 1, place);
  const auto i = static_cast<std::size_t>(found - areas.begin());
  const double before = i == 0 ? 0 : areas[i - 1];
  const auto rest = static_cast<float>((place - before) / (areas[i] - before));
  const Vec3 a = mesh.positions[mesh.triangles[i].x];
  const Vec3 ab = mesh.positions[mesh.triangles[i].y] - a;
  const Vec3 ac = mesh.positions[mesh.triangles[i].z] - a;
  const float root = std::sqrt(std::clamp(rest, 0.0f, 1.0f));
  return {a + root * (1 - u.y) * ab + root * u.y * ac, normal_of(ab, ac), Rgb(0),
          carlo::rounding_bound(12) * (glm::abs(a) + glm::abs(ab) + glm::abs(ac))};
}

}  // namespace

Light::Light(const carlo::Shape& shape) : shape_(&shape) {
  area_ = carlo::match(
      shape.geometry, [](const Parallelogram& s) { return area_between(s.u, s.v); },
      [](const Sphere& s) { return 4 * carlo::pi_f * carlo::sqr(s.radius); },
      [](const Disk& s) { return carlo::pi_f * carlo::sqr(s.radius); },
      [&](const Mesh& s) {
        triangle_areas_ = running_areas(s);
        return static_cast<float>(triangle_areas_.back());
      },
      [](const Sdf&) -> float { throw carlo::Error("an sdf cannot emit"); });
}

LightPoint Light::sample(Vec2 u) const {
  LightPoint point = carlo::match(
      shape_->geometry, [&](const Parallelogram& s) { return point_on(s, u); },
      [&](const Sphere& s) { return point_on(s, u); },
      [&](const Disk& s) { return point_on(s, u); },
      [&](const Mesh& s) { return point_on(s, triangle_areas_, u); },
      [](const Sdf&) { return LightPoint{}; });  // there is no such light
  point.radiance = shape_->radiance;
  return point;
}

}  // namespace lab08
