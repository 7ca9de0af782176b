#include "scene/center.h"

#include "scene/sdf.h"

#include <variant>

namespace carlo {
namespace {

using Vec3d = glm::dvec3;

struct Extent {
  Vec3d lower, upper;

  void include(Vec3d p, double margin = 0) {
    lower = glm::min(lower, p - Vec3d(margin));
    upper = glm::max(upper, p + Vec3d(margin));
  }
  void operator()(const Sphere& s) { include(Vec3d(s.center), static_cast<double>(s.radius)); }
  void operator()(const Disk& s) { include(Vec3d(s.center), static_cast<double>(s.radius)); }
  void operator()(const Parallelogram& s) {
    const Vec3d o(s.origin), u(s.u), v(s.v);
    for (const Vec3d& p : {o, o + u, o + v, o + u + v})
      include(p);
  }
  void operator()(const Mesh& s) {
    for (const Vec3 p : s.positions)
      include(Vec3d(p));
  }
  void operator()(const Sdf& s) {
    const sdf::Box box = sdf::bounds(s, s.place);
    include(box.lower);
    include(box.upper);
  }
};

Extent extent_of(const Scene& scene) {
  Extent extent{Vec3d(scene.camera.origin), Vec3d(scene.camera.origin)};
  for (const Shape& shape : scene.shapes)
    std::visit([&](const auto& s) { extent(s); }, shape.geometry);
  const auto& [points, environment, envmap] = scene.lights;
  (void)environment, (void)envmap;  // are everywhere
  for (const PointLight& light : points)
    extent.include(Vec3d(light.position));
  return extent;
}

}  // namespace

double diameter(const Scene& scene) {
  const Extent extent = extent_of(scene);
  return glm::length(extent.upper - extent.lower);
}

std::optional<glm::dvec3> far_center(const Scene& scene) {
  constexpr double far = 8;
  if (scene.shapes.empty()) return std::nullopt;
  const Extent extent = extent_of(scene);
  const Vec3d center = 0.5 * (extent.lower + extent.upper);
  if (!(glm::length(center) > far * glm::length(extent.upper - extent.lower))) return std::nullopt;
  return center;
}

}  // namespace carlo
