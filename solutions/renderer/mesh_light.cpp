#include "mesh_light.h"

#include "numeric/robust.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace renderer {
namespace {

using carlo::Vec2;
using carlo::Vec3;
using Vec3d = glm::dvec3;

/// The normal, with twice the triangle's area as its length.
Vec3d long_normal(const carlo::Mesh& mesh, glm::uvec3 corner) {
  const Vec3d a(mesh.positions[corner.x]);
  return glm::cross(Vec3d(mesh.positions[corner.y]) - a, Vec3d(mesh.positions[corner.z]) - a);
}

LightTree tree_of(const carlo::Mesh& mesh) {
  std::vector<LightBounds> bounds;
  bounds.reserve(mesh.triangles.size());
  for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i)
    bounds.push_back(triangle_bounds(mesh, i, 1));
  return LightTree(bounds);
}

}  // namespace

double triangle_area(const carlo::Mesh& mesh, std::uint32_t triangle) {
  return 0.5 * glm::length(long_normal(mesh, mesh.triangles[triangle]));
}

LightBounds triangle_bounds(const carlo::Mesh& mesh, std::uint32_t triangle, double radiance) {
  const glm::uvec3 corner = mesh.triangles[triangle];
  const Vec3d a(mesh.positions[corner.x]), b(mesh.positions[corner.y]), c(mesh.positions[corner.z]);
  const Vec3d normal = long_normal(mesh, corner);
  return {glm::min(a, glm::min(b, c)), glm::max(a, glm::max(b, c)), glm::normalize(normal), 1,
          radiance * 0.5 * glm::length(normal)};
}

carlo::TrianglePoint sample_triangle(const carlo::Mesh& mesh, std::uint32_t triangle, Vec2 u) {
  const glm::uvec3 corner = mesh.triangles[triangle];
  const Vec3 a = mesh.positions[corner.x], ab = mesh.positions[corner.y] - a,
             ac = mesh.positions[corner.z] - a;
  const float root = std::sqrt(u.x);
  return {a + root * (1 - u.y) * ab + root * u.y * ac,
          carlo::rounding_bound(12) * (glm::abs(a) + glm::abs(ab) + glm::abs(ac)),
          Vec3(glm::normalize(glm::cross(Vec3d(ab), Vec3d(ac))))};
}

MeshLight::MeshLight(const carlo::Mesh& mesh) : mesh_(&mesh), tree_(tree_of(mesh)) {
  double sum = 0;
  for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i)
    areas_.push_back(sum += triangle_area(mesh, i));
}

MeshLight::Sample MeshLight::sample(Vec2 u) const {
  double x = with_more_digits(u.x, u);
  const auto triangle = static_cast<std::uint32_t>(pick(areas_, x));
  return {sample_triangle(*mesh_, triangle, {below_one(x), u.y}), triangle, 1 / area()};
}

MeshLight::Sample MeshLight::sample(Vec3 p, Vec3 n, Vec2 u) const {
  const auto choice = tree_.sample(p, n, with_more_digits(u.x, u));
  if (!choice) return {};
  const std::uint32_t triangle = choice->light;
  return {sample_triangle(*mesh_, triangle, {below_one(choice->u), u.y}), triangle,
          choice->probability / triangle_area(*mesh_, triangle)};
}

double MeshLight::density(Vec3 p, Vec3 n, std::uint32_t triangle) const {
  return tree_.probability(triangle, p, n) / triangle_area(*mesh_, triangle);
}

}  // namespace renderer
