#pragma once

#include "numeric/vec.h"
#include "renderer/lanes/lane_scene.h"
#include "scene/scene.h"

#include <cstddef>

namespace renderer {

// Entries of LaneScene's columns, computed in double and rounded once.

inline float rounded(double x) {
  return static_cast<float>(x);
}

struct Reflectances {
  carlo::Rgb kd{0}, ks{0};
  float exponent = 0;
  bool specular = false;
  float ior = 0;  ///< for glass
};

Reflectances reflectances(const carlo::Material& material);

/// R + G + B.
double sum(carlo::Rgb c);
double area(const carlo::Parallelogram& quad);
double area(const carlo::Disk& disk);
double area(const carlo::Sphere& sphere);

/// Writes the plane and the outline of surface i.
void add_plane(LaneScene& lanes, std::size_t i, const carlo::Parallelogram& quad);
/// Appends a material.
void add_material(LaneScene& lanes, const carlo::Material& material);
/// Writes light l: corner and edges of a parallelogram, center and radii of a disk.
void add_edges(LaneScene& lanes, std::size_t l, carlo::Vec3 o, carlo::Vec3 u, carlo::Vec3 v);

}  // namespace renderer
