#include "given/world.h"

#include "cli/error.h"
#include "geometry/shadow_ray.h"
#include "numeric/robust.h"
#include "scene/match.h"

#include <utility>

namespace lab08 {
namespace {

Material material_of(const carlo::Material& material) {
  struct Visitor {
    Material operator()(const carlo::Diffuse& m) const {
      return carlo::Phong{m.reflectance, Rgb(0), 0};
    }
    Material operator()(const carlo::Phong& m) const { return m; }
    Material operator()(const carlo::Mirror& m) const { return m; }
    Material operator()(const carlo::Dielectric& m) const { return m; }
  };
  return std::visit(Visitor{}, material.model);
}

/// Whether light goes through, so that the back is not black.
bool passes_light(const Material& material) {
  return carlo::match(
      material, [](const carlo::Phong&) { return false; },
      [](const carlo::Mirror&) { return false; }, [](const carlo::Dielectric&) { return true; });
}

carlo::Scene checked(carlo::Scene scene) {
  const auto& [points, environment, envmap] = scene.lights;
  (void)environment;  // World::environment()
  if (envmap) {
    throw carlo::Error(
        "lab 08 knows no image as a lamp: the reference renderer draws this scene, or give it a "
        "constant environment");
  }
  if (!points.empty()) {
    throw carlo::Error("lab 08 knows no point lights: give the light an area");
  }
  return scene;
}

const Material black = carlo::Phong{Rgb(0), Rgb(0), 0};

}  // namespace

const carlo::Phong& Surface::phong() const {
  if (const auto* phong = std::get_if<carlo::Phong>(material)) return *phong;
  throw carlo::Error("mirrors and glass have no BRDF to evaluate: they come with Lab 8.7");
}

World::World(carlo::Scene scene) : scene_(checked(std::move(scene))), intersector_(scene_) {
  for (const carlo::Material& material : scene_.materials)
    materials_.push_back(material_of(material));
  for (const carlo::Shape& shape : scene_.shapes) {
    light_of_shape_.push_back(shape.emits() ? static_cast<std::int32_t>(lights_.size()) : -1);
    if (shape.emits()) lights_.emplace_back(shape);
  }
}

std::optional<Surface> World::intersect(const Ray& ray) const {
  carlo::Hit hit;
  if (!intersector_.intersect(ray, hit)) return std::nullopt;
  const carlo::Shape& shape = scene_.shapes[hit.shape];
  const bool front = glm::dot(hit.n, ray.d) < 0;
  const Material* material = &materials_[shape.material];
  const bool seen = front || scene_.materials[shape.material].two_sided || passes_light(*material);
  return Surface{hit.p,
                 front ? hit.n : -hit.n,
                 -ray.d,
                 front ? shape.radiance : Rgb(0),
                 seen ? material : &black,
                 front,
                 hit};
}

Ray World::leave(const Surface& surface, Vec3 wi) const {
  return {carlo::offset_origin(surface.p, surface.hit.p_error, surface.hit.n, surface.wo, wi), wi};
}

bool World::sees(const Surface& surface, const LightPoint& light) const {
  const Vec3 o = carlo::offset_origin(surface.p, surface.hit.p_error, surface.hit.n, surface.wo,
                                      light.p - surface.p);
  const carlo::ShadowRay shadow = carlo::shadow_ray(o, light.p, light.p_error, light.n);
  return !intersector_.occluded(shadow.ray, shadow.length);
}

const Light* World::light_of(const Surface& surface) const {
  const std::int32_t light = light_of_shape_[surface.hit.shape];
  return light < 0 ? nullptr : &lights_[static_cast<std::size_t>(light)];
}

}  // namespace lab08
