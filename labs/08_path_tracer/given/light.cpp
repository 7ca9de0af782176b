#include "given/world.h"
#include "hemisphere.h"
#include "numeric/robust.h"
#include "scene/match.h"
#include "support/error.h"

#include <cmath>

namespace lab08 {
namespace {

using carlo::Disk;
using carlo::Mesh;
using carlo::Parallelogram;
using carlo::Sdf;
using carlo::Sphere;

using Vec3d = glm::dvec3;

/// The area spanned by edges u and v, in double: squares of their product may be outside float's
/// range.
float area_between(Vec3 u, Vec3 v) {
  return static_cast<float>(glm::length(glm::cross(Vec3d(u), Vec3d(v))));
}
Vec3 normal_of(Vec3 u, Vec3 v) {
  return Vec3(glm::normalize(glm::cross(Vec3d(u), Vec3d(v))));
}

/// The edges of a mesh's triangle from its first corner.
struct Edges {
  Vec3 corner, ab, ac;
};
Edges edges_of(const Mesh& mesh, std::uint32_t triangle) {
  const glm::uvec3 corners = mesh.triangles[triangle];
  const Vec3 a = mesh.positions[corners.x];
  return {a, mesh.positions[corners.y] - a, mesh.positions[corners.z] - a};
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

LightPoint point_on(const Edges& t, Vec2 u) {
  const float root = std::sqrt(u.x);
  return {t.corner + root * (1 - u.y) * t.ab + root * u.y * t.ac, normal_of(t.ab, t.ac), Rgb(0),
          carlo::rounding_bound(12) * (glm::abs(t.corner) + glm::abs(t.ab) + glm::abs(t.ac))};
}

}  // namespace

Light::Light(const carlo::Shape& shape, std::uint32_t triangle)
    : shape_(&shape), triangle_(triangle) {
  area_ = carlo::match(
      shape.geometry, [](const Parallelogram& s) { return area_between(s.u, s.v); },
      [](const Sphere& s) { return 4 * carlo::pi_f * carlo::sqr(s.radius); },
      [](const Disk& s) { return carlo::pi_f * carlo::sqr(s.radius); },
      [&](const Mesh& s) {
        const Edges edges = edges_of(s, triangle);
        return 0.5f * area_between(edges.ab, edges.ac);
      },
      [](const Sdf&) -> float { throw carlo::Error("an sdf cannot emit"); });
}

LightPoint Light::sample(Vec2 u) const {
  LightPoint point = carlo::match(
      shape_->geometry, [&](const Parallelogram& s) { return point_on(s, u); },
      [&](const Sphere& s) { return point_on(s, u); },
      [&](const Disk& s) { return point_on(s, u); },
      [&](const Mesh& s) { return point_on(edges_of(s, triangle_), u); },
      [](const Sdf&) { return LightPoint{}; });  // no such light exists
  point.radiance = shape_->radiance;
  return point;
}

}  // namespace lab08
