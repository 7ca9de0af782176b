#include "geometry/planes.h"

#include "numeric/robust.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace carlo {
namespace {

using Vec3d = glm::dvec3;

double coordinates_of(const Vec3d& v) {
  return std::abs(v.x) + std::abs(v.y) + std::abs(v.z);
}

struct Plane {
  std::array<Vec3d, 4> corners;
  Vec3d n;
  double offset;  ///< from the origin

  explicit Plane(const Parallelogram& s) {
    const Vec3d o(s.origin), u(s.u), v(s.v);
    corners = {o, o + u, o + v, o + u + v};
    n = glm::normalize(glm::cross(u, v));
    offset = std::abs(glm::dot(n, o));
  }
};

/// How far `points` lie from the plane; below 0 if that is more than rounding explains.
double gap_to(const std::array<Vec3d, 4>& points, const Plane& plane) {
  constexpr double unit = rounding_bound(4);
  double gap = 0;
  for (const Vec3d& p : points) {
    const double distance = std::abs(glm::dot(plane.n, p - plane.corners[0]));
    if (!(distance <= unit * (coordinates_of(p) + plane.offset))) return -1;
    gap = std::max(gap, distance);
  }
  return gap;
}

}  // namespace

Planes find_planes(std::span<const Parallelogram> parallelograms) {
  Planes planes;
  std::vector<std::pair<std::uint32_t, Plane>> firsts;
  for (std::uint32_t i = 0; i < parallelograms.size(); ++i) {
    const Plane plane(parallelograms[i]);
    Planes::Entry entry{i, 0};
    for (const auto& [first, other] : firsts) {
      const double there = gap_to(plane.corners, other);
      if (there < 0) continue;
      const double back = gap_to(other.corners, plane);
      if (back < 0) continue;
      entry = {first, std::max(there, back)};
      break;
    }
    if (entry.first == i) firsts.emplace_back(i, plane);
    planes.of.push_back(entry);
  }
  return planes;
}

}  // namespace carlo
