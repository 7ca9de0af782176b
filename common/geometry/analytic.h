#pragma once

#include "scene/scene.h"

namespace carlo {

/// A parallelogram with precomputed plane and edge vectors. In double: in float, the plane of a
/// large one is too imprecise to separate it from nearby surfaces.
struct Quad {
  glm::dvec3 origin, n;  ///< n of length 1
  glm::dvec3 a, b;       ///< dual to the edges: a u = 1, a v = 0, b u = 0, b v = 1
  double reach_a,
      reach_b;  ///< the possible rounding error of its coordinates, in units of the edges

  explicit Quad(const Parallelogram& s);

  /// True if a point of its plane lies on it. Of two that share an edge, at least one returns true,
  /// however their corners were rounded.
  bool holds(const glm::dvec3& p) const;
};

/// The nearest t in (tnear, tfar) at which the ray o + t d, |d| = 1, meets the surface; a negative
/// value if there is none. In double: with float discriminants a sphere of radius 1 at distance 1e4
/// loses a quarter of its hits.
double intersect_quad(const Quad& quad, Vec3 o, Vec3 d, float tnear, float tfar);
double intersect_sphere(const Sphere& sphere, Vec3 o, Vec3 d, float tnear, float tfar);
double intersect_disk(const Disk& disk, Vec3 o, Vec3 d, float tnear, float tfar);

/// A point of the surface near o + t d, rounded to float once, and its unit normal.
struct SurfacePoint {
  Vec3 p, n;
};
SurfacePoint quad_point(const Quad& quad, Vec3 o, Vec3 d, double t);
SurfacePoint sphere_point(const Sphere& sphere, Vec3 o, Vec3 d, double t);
SurfacePoint disk_point(const Disk& disk, Vec3 o, Vec3 d, double t);

}  // namespace carlo
