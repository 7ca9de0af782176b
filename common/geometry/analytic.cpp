#include "geometry/analytic.h"

#include "numeric/robust.h"

#include <cmath>

namespace carlo {
namespace {

using Vec3d = glm::dvec3;

}  // namespace

Quad::Quad(const Parallelogram& s) : origin(s.origin) {
  const Vec3d u(s.u), v(s.v);
  n = glm::normalize(glm::cross(u, v));
  const Vec3d across = glm::cross(v, n), along = glm::cross(n, u);
  a = across / glm::dot(across, u);
  b = along / glm::dot(along, v);
  // Half a unit in the last place of each corner, for this one and a neighbour.
  const Vec3d blur =
      static_cast<double>(rounding_bound(2)) * (glm::abs(origin) + glm::abs(u) + glm::abs(v));
  reach_a = glm::dot(glm::abs(a), blur);
  reach_b = glm::dot(glm::abs(b), blur);
}

bool Quad::holds(const glm::dvec3& p) const {
  const double x = glm::dot(a, p - origin), y = glm::dot(b, p - origin);
  return x >= -reach_a && x <= 1 + reach_a && y >= -reach_b && y <= 1 + reach_b;
}

double intersect_quad(const Quad& quad, Vec3 o, Vec3 d, float tnear, float tfar) {
  const Vec3d from(o), direction(d);
  const double t = glm::dot(quad.n, quad.origin - from) / glm::dot(quad.n, direction);
  if (!(t > tnear && t < tfar)) return -1;
  return quad.holds(from + t * direction) ? t : -1;
}

double intersect_sphere(const Sphere& sphere, Vec3 o, Vec3 d, float tnear, float tfar) {
  // The discriminant comes from the distance of the centre to the line, the far root without
  // cancellation, the near one from the product of the roots. Source: Haines, Guenther,
  // Akenine-Moeller, "Precision improvements for ray/sphere intersection", Ray Tracing Gems,
  // chapter 7.
  const Vec3d f = Vec3d(o) - Vec3d(sphere.center);
  const Vec3d dir = Vec3d(d) / glm::length(Vec3d(d));
  const double r = sphere.radius;
  const double b = -glm::dot(f, dir);
  const Vec3d closest = f + b * dir;
  const double discriminant = r * r - glm::dot(closest, closest);
  if (!(discriminant >= 0)) return -1;
  const double q = b + std::copysign(std::sqrt(discriminant), b);
  const double c = glm::dot(f, f) - r * r;
  const double t0 = b > 0 ? c / q : q;
  const double t1 = b > 0 ? q : c / q;
  if (t0 > tnear && t0 < tfar) return t0;
  if (t1 > tnear && t1 < tfar) return t1;
  return -1;
}

double intersect_disk(const Disk& disk, Vec3 o, Vec3 d, float tnear, float tfar) {
  const Vec3d n(disk.normal), to_center = Vec3d(disk.center) - Vec3d(o);
  const double t = glm::dot(to_center, n) / glm::dot(Vec3d(d), n);
  if (!(t > tnear && t < tfar)) return -1;
  const Vec3d from_center = t * Vec3d(d) - to_center;
  const double r = disk.radius;
  return glm::dot(from_center, from_center) <= r * r ? t : -1;
}

SurfacePoint quad_point(const Quad& quad, Vec3 o, Vec3 d, double t) {
  // t may have been rounded to float since: put the point back into the plane.
  const Vec3d p = Vec3d(o) + t * Vec3d(d);
  return {Vec3(p - glm::dot(p - quad.origin, quad.n) * quad.n), Vec3(quad.n)};
}

SurfacePoint sphere_point(const Sphere& sphere, Vec3 o, Vec3 d, double t) {
  const Vec3d center(sphere.center);
  const Vec3d n = glm::normalize(Vec3d(o) - center + t * Vec3d(d));
  const Vec3d p = center + static_cast<double>(sphere.radius) * n;
  return {Vec3(p), Vec3(sphere.flipped ? -n : n)};
}

SurfacePoint disk_point(const Disk& disk, Vec3 o, Vec3 d, double t) {
  // t may have been rounded to float since: put the point back into the plane.
  const Vec3d n(disk.normal), p = Vec3d(o) + t * Vec3d(d);
  const double height = glm::dot(p - Vec3d(disk.center), n) / glm::dot(n, n);
  return {Vec3(p - height * n), disk.normal};
}

}  // namespace carlo
