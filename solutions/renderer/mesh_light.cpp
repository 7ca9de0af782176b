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

double triangle_area(const carlo::Mesh& mesh, glm::uvec3 corner) {
  const Vec3d a(mesh.positions[corner.x]);
  return 0.5 * glm::length(glm::cross(Vec3d(mesh.positions[corner.y]) - a,
                                      Vec3d(mesh.positions[corner.z]) - a));
}

}  // namespace

std::vector<double> running_sum(std::vector<double> values) {
  double sum = 0;
  for (double& v : values)
    v = sum += v;
  return values;
}

std::size_t pick(std::span<const double> sums, float& u) {
  const double x = static_cast<double>(u) * sums.back();
  const auto it = std::upper_bound(sums.begin(), sums.end() - 1, x);
  const auto i = static_cast<std::size_t>(it - sums.begin());
  const double lower = i == 0 ? 0 : sums[i - 1];
  u = std::clamp(static_cast<float>((x - lower) / (sums[i] - lower)), 0.0f, 0x1.fffffep-1f);
  return i;
}

MeshLight::MeshLight(const carlo::Mesh& mesh) : mesh_(&mesh) {
  std::vector<double> areas;
  areas.reserve(mesh.triangles.size());
  for (const glm::uvec3 corner : mesh.triangles)
    areas.push_back(triangle_area(mesh, corner));
  areas_ = running_sum(std::move(areas));
}

carlo::TrianglePoint MeshLight::sample(Vec2 u) const {
  const glm::uvec3 corner = mesh_->triangles[pick(areas_, u.x)];
  const Vec3 a = mesh_->positions[corner.x], ab = mesh_->positions[corner.y] - a,
             ac = mesh_->positions[corner.z] - a;
  const float root = std::sqrt(u.x);
  return {a + root * (1 - u.y) * ab + root * u.y * ac,
          carlo::rounding_bound(12) * (glm::abs(a) + glm::abs(ab) + glm::abs(ac)),
          Vec3(glm::normalize(glm::cross(Vec3d(ab), Vec3d(ac))))};
}

}  // namespace renderer
