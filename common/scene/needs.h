#pragma once

#include "scene/scene.h"

#include <cstddef>
#include <string>

namespace carlo {

/// The demands of a scene on a renderer: the numbers of each shape and light, and the materials
/// that occur on shapes. A renderer chooses its kernel by this.
struct Needs {
  std::size_t parallelograms = 0, spheres = 0, disks = 0, meshes = 0, triangles = 0, sdfs = 0;
  bool diffuse = false, phong = false, mirror = false, dielectric = false;
  bool one_sided = false, two_sided = false;  ///< among surfaces that are no dielectric
  std::size_t parallelogram_lights = 0, sphere_lights = 0, disk_lights = 0, triangle_lights = 0;
  std::size_t point_lights = 0;
  bool environment = false, envmap = false;
  bool depth_limit = false;
  bool vertex_normals = false;

  std::size_t primitives() const { return parallelograms + spheres + disks + triangles + sdfs; }
  std::size_t area_lights() const {
    return parallelogram_lights + sphere_lights + disk_lights + triangle_lights;
  }
  bool operator==(const Needs&) const = default;
};

Needs needs(const Scene& scene);

/// True if light passes through: such a surface has no black back.
bool passes_light(const Material& material);

/// One line for the report: "18 parallelograms; phong, two-sided; 1 parallelogram light".
std::string describe(const Needs& needs);

}  // namespace carlo
