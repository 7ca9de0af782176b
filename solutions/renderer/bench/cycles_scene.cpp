#include "cycles_scene.h"

#include "cli/error.h"
#include "scene/match.h"
#include "scene/needs.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace bench {
namespace {

using carlo::Scene;
using nlohmann::json;

json numbers(const carlo::Vec3& v) {
  return {v.x, v.y, v.z};
}

/// Cycles stops at this many.
constexpr int most_bounces = 1024;

/// Cycles does not count the segment from the camera nor the one to the light: 0 is direct light.
int bounces(const Scene& scene) {
  return scene.max_depth == 0 ? most_bounces : std::clamp(scene.max_depth - 2, 0, most_bounces);
}

/// Corners and faces, whatever the shape was.
struct Polygons {
  std::vector<carlo::Vec3> positions;
  json faces = json::array();
};

Polygons polygons(const carlo::Shape& shape) {
  const auto curved = [] { return carlo::Error("Cycles has no exact curved shapes"); };
  return carlo::match(
      shape.geometry,
      [](const carlo::Parallelogram& p) -> Polygons {
        return {{p.origin, p.origin + p.u, p.origin + p.u + p.v, p.origin + p.v},
                json::array({{0, 1, 2, 3}})};
      },
      [](const carlo::Mesh& mesh) {
        Polygons result{mesh.positions};
        for (const glm::uvec3& triangle : mesh.triangles)
          result.faces.push_back({triangle.x, triangle.y, triangle.z});
        return result;
      },
      [&](const carlo::Sphere&) -> Polygons { throw curved(); },
      [&](const carlo::Disk&) -> Polygons { throw curved(); },
      [&](const carlo::Sdf&) -> Polygons { throw curved(); });
}

/// The power of two that brings the largest coordinate into [1/2, 1). Radiances do not depend on
/// the scale, but Cycles' light does: of the Cornell box in millimetres the walls lose 2 % where
/// the lamp's light grazes them, with a largest coordinate of 6 still 1 %, below 1 nothing that 256
/// samples a pixel show.
float to_unit_size(const Scene& scene) {
  float largest = 0;
  const auto meet = [&](const carlo::Vec3& p) {
    for (int i = 0; i < 3; ++i)
      largest = std::max(largest, std::abs(p[i]));
  };
  meet(scene.camera.origin);
  for (const carlo::Shape& shape : scene.shapes) {
    for (const carlo::Vec3& p : polygons(shape).positions)
      meet(p);
  }
  return largest > 0 ? std::ldexp(1.0f, -1 - std::ilogb(largest)) : 1;
}

json mesh(const carlo::Shape& shape, float scale, std::ptrdiff_t material) {
  const Polygons p = polygons(shape);
  json positions = json::array();
  for (const carlo::Vec3& position : p.positions)
    positions.push_back(numbers(scale * position));
  return {{"positions", positions}, {"faces", p.faces}, {"material", material}};
}

json material(const Scene& scene, const carlo::Shape& shape) {
  const carlo::Material& m = scene.materials[shape.material];
  // Paths of one segment see lights and reflect nothing.
  const carlo::Rgb reflectance =
      scene.max_depth == 1 ? carlo::Rgb(0) : std::get<carlo::Diffuse>(m.model).reflectance;
  return {{"reflectance", numbers(reflectance)},
          {"radiance", numbers(shape.radiance)},
          {"two_sided", m.two_sided}};
}

json camera(const carlo::Camera& c, float scale) {
  return {{"origin", numbers(scale * c.origin)},
          {"right", numbers(c.right)},
          {"up", numbers(c.up)},
          {"forward", numbers(c.forward)},
          {"tan_half_x", c.tan_half_x}};
}

}  // namespace

std::optional<std::string> cycles_obstacle(const Scene& scene) {
  const carlo::Needs n = carlo::needs(scene);
  if (n.spheres > 0) return "spheres";
  if (n.disks > 0) return "disks";
  if (n.sdfs > 0) return "signed distance functions";
  if (n.phong || n.mirror || n.dielectric) return "surfaces that are not diffuse";
  if (n.point_lights > 0) return "a point light";
  if (n.environment) return "a light all around";
  const carlo::Camera& c = scene.camera;
  if (glm::dot(glm::cross(c.right, c.up), c.forward) > 0) return "a camera that mirrors";
  carlo::Needs others = n;
  others.parallelograms = others.meshes = others.triangles = 0;
  others.parallelogram_lights = others.triangle_lights = 0;
  others.diffuse = others.one_sided = others.two_sided = others.depth_limit = false;
  if (others != carlo::Needs{}) return "something that is new here";
  return {};
}

json cycles_scene(const Scene& scene) {
  if (const auto obstacle = cycles_obstacle(scene)) {
    throw carlo::Error("Cycles cannot render exactly {}", *obstacle);
  }
  const float scale = to_unit_size(scene);
  json materials = json::array(), meshes = json::array();
  for (const carlo::Shape& shape : scene.shapes) {
    const json wanted = material(scene, shape);
    const auto found = std::find(materials.begin(), materials.end(), wanted);
    meshes.push_back(mesh(shape, scale, found - materials.begin()));
    if (found == materials.end()) materials.push_back(wanted);
  }
  return {{"width", scene.width},      {"height", scene.height},
          {"bounces", bounces(scene)}, {"camera", camera(scene.camera, scale)},
          {"materials", materials},    {"meshes", meshes}};
}

}  // namespace bench
