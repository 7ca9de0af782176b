#pragma once

#include "scene/scene.h"

namespace carlo {

/// The nearest t in (tnear, tfar) at which the ray o + t d, |d| = 1, meets the surface; a negative
/// value if there is none. In double: with float discriminants a sphere of radius 1 at distance 1e4
/// loses a quarter of its hits.
double intersect_sphere(const Sphere& sphere, Vec3 o, Vec3 d, float tnear, float tfar);
double intersect_disk(const Disk& disk, Vec3 o, Vec3 d, float tnear, float tfar);

/// A point of the surface near o + t d, rounded to float once, and its unit normal.
struct SurfacePoint {
  Vec3 p, n;
};
SurfacePoint sphere_point(const Sphere& sphere, Vec3 o, Vec3 d, double t);
SurfacePoint disk_point(const Disk& disk, Vec3 o, Vec3 d, double t);

}  // namespace carlo
