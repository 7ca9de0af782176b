#include "scene/needs.h"

#include "scene/match.h"

#include <fmt/format.h>

#include <string_view>
#include <vector>

namespace carlo {
namespace {

void count(const Shape& shape, Needs& n) {
  const std::size_t light = shape.emits() ? 1 : 0;
  match(
      shape.geometry,
      [&](const Parallelogram&) {
        ++n.parallelograms;
        n.parallelogram_lights += light;
      },
      [&](const Sphere&) {
        ++n.spheres;
        n.sphere_lights += light;
      },
      [&](const Disk&) {
        ++n.disks;
        n.disk_lights += light;
      },
      [&](const Mesh& mesh) {
        ++n.meshes;
        n.triangles += mesh.triangles.size();
        n.triangle_lights += light * mesh.triangles.size();
        n.vertex_normals |= !mesh.normals_of.empty();
      },
      [&](const Sdf&) { ++n.sdfs; });
}

void add_material(const Material& material, Needs& n) {
  bool& side = material.two_sided ? n.two_sided : n.one_sided;
  match(
      material.model, [&](const Diffuse&) { n.diffuse = side = true; },
      [&](const Phong&) { n.phong = side = true; }, [&](const Mirror&) { n.mirror = side = true; },
      [&](const Dielectric&) { n.dielectric = true; });
}

void add_lights(const OtherLights& lights, Needs& n) {
  const auto& [points, environment, envmap] = lights;
  n.point_lights = points.size();
  n.environment = environment != Rgb(0);
  n.envmap = envmap.has_value();
}

std::string counted(std::size_t number, std::string_view thing) {
  return fmt::format("{} {}{}", number, thing, number == 1 ? "" : "s");
}

// Joins the existing parts with commas.
class List {
 public:
  void add(std::size_t number, std::string_view thing) {
    if (number > 0) parts_.push_back(counted(number, thing));
  }
  void add(bool there, std::string_view thing) {
    if (there) parts_.emplace_back(thing);
  }
  std::string text(std::string_view otherwise) const {
    return parts_.empty() ? std::string(otherwise) : fmt::format("{}", fmt::join(parts_, ", "));
  }

 private:
  std::vector<std::string> parts_;
};

}  // namespace

Needs needs(const Scene& scene) {
  Needs n;
  for (const Shape& shape : scene.shapes) {
    count(shape, n);
    add_material(scene.materials.at(shape.material), n);
  }
  add_lights(scene.lights, n);
  n.depth_limit = scene.max_depth > 0;
  return n;
}

bool passes_light(const Material& material) {
  return match(
      material.model, [](const Diffuse&) { return false; }, [](const Phong&) { return false; },
      [](const Mirror&) { return false; }, [](const Dielectric&) { return true; });
}

std::string describe(const Needs& n) {
  // Adding a member is a compile error here, until it is described or ignored on purpose.
  const auto& [parallelograms, spheres, disks, meshes, triangles, sdfs, diffuse, phong, mirror,
               dielectric, one_sided, two_sided, parallelogram_lights, sphere_lights, disk_lights,
               triangle_lights, point_lights, environment, envmap, depth_limit, vertex_normals] = n;
  (void)meshes, (void)depth_limit;
  List shapes, materials, lights;
  shapes.add(parallelograms, "parallelogram");
  shapes.add(spheres, "sphere");
  shapes.add(disks, "disk");
  shapes.add(triangles, "triangle");
  shapes.add(vertex_normals, "vertex normals");
  shapes.add(sdfs, "sdf");
  materials.add(diffuse, "diffuse");
  materials.add(phong, "phong");
  materials.add(mirror, "mirror");
  materials.add(dielectric, "dielectric");
  materials.add(one_sided, "one-sided");
  materials.add(two_sided, "two-sided");
  lights.add(parallelogram_lights, "parallelogram light");
  lights.add(sphere_lights, "sphere light");
  lights.add(disk_lights, "disk light");
  lights.add(triangle_lights, "triangle light");
  lights.add(point_lights, "point light");
  lights.add(environment, "constant environment");
  lights.add(envmap, "environment map");
  return fmt::format("{}; {}; {}", shapes.text("no shapes"), materials.text("no materials"),
                     lights.text("no lights"));
}

}  // namespace carlo
