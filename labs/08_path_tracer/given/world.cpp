#include "given/world.h"

#include "geometry/shadow_ray.h"
#include "numeric/robust.h"
#include "scene/match.h"
#include "support/error.h"

#include <algorithm>
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

/// True if light passes through, so that the back is not black.
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
        "lab 8 does not support environment maps: use the reference renderer, or a "
        "constant environment");
  }
  if (!points.empty()) {
    throw carlo::Error("lab 8 does not support point lights: use an area light");
  }
  return scene;
}

const Material black = carlo::Phong{Rgb(0), Rgb(0), 0};

/// Source: ITU-R BT.709.
double luminance(Rgb c) {
  const glm::dvec3 exact(c);
  return 0.2126 * exact.r + 0.7152 * exact.g + 0.0722 * exact.b;
}

/// The number of lights of an emitting shape.
std::uint32_t pieces_of(const carlo::Shape& shape) {
  const auto* mesh = std::get_if<carlo::Mesh>(&shape.geometry);
  return mesh != nullptr ? static_cast<std::uint32_t>(mesh->triangles.size()) : 1;
}

}  // namespace

const carlo::Phong& Surface::phong() const {
  if (const auto* phong = std::get_if<carlo::Phong>(material)) return *phong;
  throw carlo::Error("mirrors and glass have no BRDF to evaluate: they come with Lab 8.7");
}

World::World(carlo::Scene scene) : scene_(checked(std::move(scene))), intersector_(scene_) {
  for (const carlo::Material& material : scene_.materials)
    materials_.push_back(material_of(material));
  find_lights();
}

void World::find_lights() {
  double emitters = 0;
  std::vector<double> siblings;  // for each light: the number of its shape's lights with nonzero
                                 // area
  const auto has_area = [](const Light& light) { return light.area() > 0; };
  for (const carlo::Shape& shape : scene_.shapes) {
    const std::size_t first = lights_.size();
    light_of_shape_.push_back(shape.emits() ? static_cast<std::int64_t>(first) : -1);
    for (std::uint32_t piece = 0; shape.emits() && piece < pieces_of(shape); ++piece)
      lights_.emplace_back(shape, piece);
    const auto begin = lights_.begin() + static_cast<std::ptrdiff_t>(first);
    const auto lit = std::count_if(begin, lights_.end(), has_area);
    siblings.resize(lights_.size(), static_cast<double>(lit));
    emitters += lit > 0 ? 1 : 0;
  }
  std::vector<LightWeight> weights;
  for (std::size_t i = 0; i < lights_.size(); ++i) {
    const Light& light = lights_[i];
    const double power = static_cast<double>(light.area()) * luminance(light.shape_->radiance);
    weights.push_back({std::max(power, 0.0), has_area(light) ? 1 / (emitters * siblings[i]) : 0.0});
  }
  choice_ = LightChoice(weights);
  for (std::size_t i = 0; i < lights_.size(); ++i)
    lights_[i].chance_ = choice_.chance(i);
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
  const std::int64_t first = light_of_shape_[surface.hit.shape];
  return first < 0 ? nullptr : &lights_[static_cast<std::size_t>(first) + surface.hit.primitive];
}

}  // namespace lab08
