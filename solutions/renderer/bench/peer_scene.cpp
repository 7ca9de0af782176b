#include "peer_scene.h"

#include "scene/match.h"
#include "scene/needs.h"
#include "support/error.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <utility>
#include <vector>

namespace bench {
namespace {

using carlo::Scene;
using nlohmann::json;

json numbers(const carlo::Vec3& v) {
  return {v.x, v.y, v.z};
}

/// Cycles allows no more.
constexpr int most_bounces = 1024;

/// Cycles does not count the segment from the camera nor the one to the light: 0 is direct light.
int bounces(const Scene& scene) {
  return scene.max_depth == 0 ? most_bounces : std::clamp(scene.max_depth - 2, 0, most_bounces);
}

/// Corners and faces of any shape.
struct Polygons {
  std::vector<carlo::Vec3> positions;
  json faces = json::array();
};

/// An icosahedron whose faces were cut in four six times. Its radius exceeds the sphere's by 2e-5,
/// which keeps the average area the same.
Polygons polygons(const carlo::Sphere& sphere) {
  constexpr double golden = 1.618033988749895;
  std::vector<glm::dvec3> points;
  for (const double a : {-1.0, 1.0}) {
    for (const double b : {-golden, golden}) {
      points.emplace_back(0, a, b);
      points.emplace_back(a, b, 0);
      points.emplace_back(b, 0, a);
    }
  }
  std::vector<glm::uvec3> faces;
  for (unsigned i = 0; i < 12; ++i) {
    for (unsigned j = i + 1; j < 12; ++j) {
      for (unsigned k = j + 1; k < 12; ++k) {
        const auto next = [&](unsigned p, unsigned q) {
          return glm::distance(points[p], points[q]) < 2.1;
        };
        if (!next(i, j) || !next(j, k) || !next(i, k)) continue;
        const double outwards = glm::dot(glm::cross(points[j] - points[i], points[k] - points[i]),
                                         points[i] + points[j] + points[k]);
        faces.push_back(outwards > 0 ? glm::uvec3(i, j, k) : glm::uvec3(i, k, j));
      }
    }
  }
  while (faces.size() < peer_sphere_triangles) {
    std::map<std::pair<unsigned, unsigned>, unsigned> middles;
    const auto middle = [&](unsigned p, unsigned q) {
      const auto [found, is_new] =
          middles.try_emplace(std::minmax(p, q), static_cast<unsigned>(points.size()));
      if (is_new) points.push_back(points[p] + points[q]);
      return found->second;
    };
    std::vector<glm::uvec3> finer;
    for (const glm::uvec3& f : faces) {
      const unsigned a = middle(f.x, f.y), b = middle(f.y, f.z), c = middle(f.z, f.x);
      finer.insert(finer.end(), {{f.x, a, c}, {a, f.y, b}, {c, b, f.z}, {a, b, c}});
    }
    faces = std::move(finer);
    for (glm::dvec3& p : points)
      p = glm::normalize(p);
  }
  Polygons result;
  for (const glm::dvec3& p : points) {
    result.positions.push_back(
        carlo::Vec3(glm::dvec3(sphere.center) + 1.00002 * sphere.radius * p));
  }
  for (const glm::uvec3& f : faces) {
    if (sphere.flipped) {
      result.faces.push_back({f.x, f.z, f.y});
    } else {
      result.faces.push_back({f.x, f.y, f.z});
    }
  }
  return result;
}

/// For shapes that obstacle() accepts.
Polygons polygons(const carlo::Shape& shape) {
  const auto unknown = [] { return carlo::Error("a peer has no such shape"); };
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
      [](const carlo::Sphere& sphere) { return polygons(sphere); },
      [&](const carlo::Disk&) -> Polygons { throw unknown(); },
      [&](const carlo::Sdf&) -> Polygons { throw unknown(); });
}

/// The power of two that brings the largest coordinate into [1/2, 1). Radiances do not depend on
/// the scale, but Cycles' light does: at grazing angles the walls of the Cornell box lose 2 % in
/// millimetres, 1 % with a largest coordinate of 6, and below 1 nothing that 256 samples a pixel
/// show.
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
  json result{{"positions", positions}, {"faces", p.faces}, {"material", material}};
  const auto* smooth = std::get_if<carlo::Mesh>(&shape.geometry);
  if (smooth == nullptr || smooth->normals_of.empty()) return result;
  for (const carlo::Vec3& normal : smooth->normals)
    result["normals"].push_back(numbers(normal));
  return result;
}

json model(const carlo::Material& material) {
  return carlo::match(
      material.model,
      [](const carlo::Diffuse& m) -> json {
        return {{"kind", "diffuse"}, {"reflectance", numbers(m.reflectance)}};
      },
      [](const carlo::Mirror& m) -> json {
        return {{"kind", "mirror"}, {"reflectance", numbers(m.reflectance)}};
      },
      [](const carlo::Dielectric& m) -> json {
        return {{"kind", "dielectric"}, {"int_ior", m.int_ior}, {"ext_ior", m.ext_ior}};
      },
      [](const carlo::Phong&) -> json { throw carlo::Error("a peer has no modified Phong"); });
}

json material(const Scene& scene, const carlo::Shape& shape) {
  const carlo::Material& m = scene.materials[shape.material];
  // Paths of one segment see lights and reflect nothing.
  json result = scene.max_depth == 1 ? model({carlo::Diffuse{carlo::Rgb(0)}}) : model(m);
  result["radiance"] = numbers(shape.radiance);
  result["two_sided"] = m.two_sided;
  return result;
}

json camera(const carlo::Camera& c, float scale) {
  return {{"origin", numbers(scale * c.origin)},
          {"right", numbers(c.right)},
          {"up", numbers(c.up)},
          {"forward", numbers(c.forward)},
          {"tan_half_x", c.tan_half_x}};
}

/// Rows from the top, three numbers per texel; `x`, `y` and `z` are the image's axes in the scene.
json envmap_json(const carlo::Envmap& map) {
  json radiance = json::array();
  for (const carlo::Rgb& texel : map.image.pixels) {
    for (int c = 0; c < 3; ++c)
      radiance.push_back(texel[c]);
  }
  return {{"width", map.image.width},      {"height", map.image.height},
          {"radiance", radiance},          {"x", numbers(map.rotation[0])},
          {"y", numbers(map.rotation[1])}, {"z", numbers(map.rotation[2])}};
}

}  // namespace

std::optional<std::string> obstacle(const Scene& scene, Peer peer) {
  const carlo::Needs n = carlo::needs(scene);
  if (n.disks > 0) return "disks";
  if (n.sdfs > 0) return "signed distance functions";
  if (n.phong) return "Phong's lobes";
  if (n.envmap && peer != Peer::mitsuba) return "an environment map";
  if (peer == Peer::cycles) {
    if (n.spheres > 0) return "spheres";
    if (n.mirror || n.dielectric) return "surfaces that are not diffuse";
    if (n.point_lights > 0) return "a point light";
    if (n.environment) return "a constant environment";
  }
  if (peer != Peer::mitsuba && n.sphere_lights > 0) return "lights that are spheres";
  if (peer != Peer::mitsuba && n.spheres > 0 && (n.mirror || n.dielectric)) {
    return "curved mirrors or glass";
  }
  const carlo::Camera& c = scene.camera;
  if (glm::dot(glm::cross(c.right, c.up), c.forward) > 0) return "a camera that mirrors";
  carlo::Needs others = n;
  others.parallelograms = others.spheres = others.meshes = others.triangles = 0;
  others.parallelogram_lights = others.sphere_lights = others.triangle_lights = 0;
  others.point_lights = 0;
  others.diffuse = others.mirror = others.dielectric = others.environment = others.envmap = false;
  others.one_sided = others.two_sided = others.depth_limit = false;
  const auto odd = [](const carlo::Shape& shape) {
    const auto* mesh = std::get_if<carlo::Mesh>(&shape.geometry);
    return mesh != nullptr && !mesh->normals_of.empty() && mesh->normals_of != mesh->triangles;
  };
  if (std::any_of(scene.shapes.begin(), scene.shapes.end(), odd))
    return "vertex normals that are not one for each vertex";
  others.vertex_normals = false;
  if (others != carlo::Needs{}) return "something that is new here";
  return {};
}

json peer_scene(const Scene& scene, Peer peer) {
  if (const auto reason = obstacle(scene, peer)) {
    throw carlo::Error("the peer cannot render exactly {}", *reason);
  }
  const float scale = to_unit_size(scene);
  json materials = json::array(), meshes = json::array(), spheres = json::array(),
       points = json::array();
  for (const carlo::Shape& shape : scene.shapes) {
    const json wanted = material(scene, shape);
    const auto found = std::find(materials.begin(), materials.end(), wanted);
    const std::ptrdiff_t number = found - materials.begin();
    if (found == materials.end()) materials.push_back(wanted);
    const auto* sphere = std::get_if<carlo::Sphere>(&shape.geometry);
    if (sphere != nullptr && peer == Peer::mitsuba) {
      spheres.push_back({{"center", numbers(scale * sphere->center)},
                         {"radius", scale * sphere->radius},
                         {"flipped", sphere->flipped},
                         {"material", number}});
    } else {
      meshes.push_back(mesh(shape, scale, number));
    }
  }
  const auto& [point_lights, environment, envmap] = scene.lights;
  for (const carlo::PointLight& light : point_lights) {
    points.push_back({{"position", numbers(scale * light.position)},
                      {"intensity", numbers(scale * scale * light.intensity)}});
  }
  return {{"width", scene.width},
          {"height", scene.height},
          {"bounces", bounces(scene)},
          {"max_depth", scene.max_depth},
          {"camera", camera(scene.camera, scale)},
          {"materials", materials},
          {"meshes", meshes},
          {"spheres", spheres},
          {"point_lights", points},
          {"environment", numbers(environment)},
          {"envmap", envmap ? envmap_json(*envmap) : json()}};
}

}  // namespace bench
