#include "render/scene_film.h"

#include "cli/error.h"

#include <algorithm>

namespace carlo {
namespace {

/// The squared length of the scene's diagonal.
double extent2(const Scene& scene) {
  Vec3 lower = scene.camera.origin, upper = lower;
  const auto include = [&](Vec3 p, float margin = 0) {
    lower = glm::min(lower, p - Vec3(margin));
    upper = glm::max(upper, p + Vec3(margin));
  };
  for (const Shape& shape : scene.shapes) {
    if (const auto* s = std::get_if<Sphere>(&shape.geometry)) include(s->center, s->radius);
    if (const auto* s = std::get_if<Disk>(&shape.geometry)) include(s->center, s->radius);
    if (const auto* s = std::get_if<Parallelogram>(&shape.geometry)) {
      include(s->origin);
      include(s->origin + s->u + s->v);
    }
    if (const auto* s = std::get_if<Mesh>(&shape.geometry)) {
      for (const Vec3 p : s->positions)
        include(p);
    }
    if (const auto* s = std::get_if<Sdf>(&shape.geometry)) {
      const sdf::Box box = sdf::bounds(*s, s->place);
      include(Vec3(box.lower));
      include(Vec3(box.upper));
    }
  }
  for (const PointLight& light : scene.points)
    include(light.position);
  const glm::dvec3 diagonal = glm::dvec3(upper) - glm::dvec3(lower);
  return glm::dot(diagonal, diagonal);
}

}  // namespace

double radiance_scale(const Scene& scene) {
  const auto brightest = [](Rgb c) { return static_cast<double>(std::max({c.r, c.g, c.b})); };
  double scale = brightest(scene.environment);
  for (const Shape& shape : scene.shapes)
    scale = std::max(scale, brightest(shape.radiance));
  const double distance2 = extent2(scene);
  for (const PointLight& light : scene.points) {
    // At a thirtieth of the scene's diagonal.
    scale = std::max(scale, 1e3 * brightest(light.intensity) / std::max(distance2, 1e-30));
  }
  return scale;
}

void resize(Scene& scene, int width, int height) {
  if (width < 1 || height < 1) {
    throw Error("the film must be at least 1x1, got {}x{}", width, height);
  }
  scene.width = width;
  scene.height = height;
  scene.camera.fit_film(width, height);
}

}  // namespace carlo
