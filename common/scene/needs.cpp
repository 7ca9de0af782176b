#include "scene/needs.h"

#include <fmt/format.h>

#include <string_view>
#include <variant>
#include <vector>

namespace carlo {
namespace {

void count(const Shape& shape, Needs& n) {
  const std::size_t light = shape.emits() ? 1 : 0;
  if (std::holds_alternative<Parallelogram>(shape.geometry)) {
    ++n.parallelograms;
    n.parallelogram_lights += light;
  } else if (std::holds_alternative<Sphere>(shape.geometry)) {
    ++n.spheres;
    n.sphere_lights += light;
  } else if (std::holds_alternative<Disk>(shape.geometry)) {
    ++n.disks;
    n.disk_lights += light;
  } else if (const Mesh* mesh = std::get_if<Mesh>(&shape.geometry)) {
    ++n.meshes;
    n.triangles += mesh->triangles.size();
    n.triangle_lights += light * mesh->triangles.size();
  } else if (std::holds_alternative<Sdf>(shape.geometry)) {
    ++n.sdfs;
  }
}

void add_material(const Material& material, Needs& n) {
  if (std::holds_alternative<Dielectric>(material.model)) {
    n.dielectric = true;
    return;
  }
  if (std::holds_alternative<Diffuse>(material.model)) n.diffuse = true;
  if (std::holds_alternative<Phong>(material.model)) n.phong = true;
  if (std::holds_alternative<Mirror>(material.model)) n.mirror = true;
  (material.two_sided ? n.two_sided : n.one_sided) = true;
}

std::string counted(std::size_t number, std::string_view thing) {
  return fmt::format("{} {}{}", number, thing, number == 1 ? "" : "s");
}

// The parts that there are, with commas between them.
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
  n.point_lights = scene.points.size();
  n.environment = scene.environment != Rgb(0);
  n.depth_limit = scene.max_depth > 0;
  return n;
}

std::string describe(const Needs& n) {
  List shapes, materials, lights;
  shapes.add(n.parallelograms, "parallelogram");
  shapes.add(n.spheres, "sphere");
  shapes.add(n.disks, "disk");
  shapes.add(n.triangles, "triangle");
  shapes.add(n.sdfs, "sdf");
  materials.add(n.diffuse, "diffuse");
  materials.add(n.phong, "phong");
  materials.add(n.mirror, "mirror");
  materials.add(n.dielectric, "dielectric");
  materials.add(n.one_sided, "one-sided");
  materials.add(n.two_sided, "two-sided");
  lights.add(n.parallelogram_lights, "parallelogram light");
  lights.add(n.sphere_lights, "sphere light");
  lights.add(n.disk_lights, "disk light");
  lights.add(n.triangle_lights, "triangle light");
  lights.add(n.point_lights, "point light");
  lights.add(n.environment, "constant environment");
  return fmt::format("{}; {}; {}", shapes.text("no shapes"), materials.text("no materials"),
                     lights.text("no lights"));
}

}  // namespace carlo
