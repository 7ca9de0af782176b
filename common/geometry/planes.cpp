#include "geometry/planes.h"

#include "numeric/robust.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>

namespace carlo {
namespace {

using Vec3d = glm::dvec3;

double coordinates_of(const Vec3d& v) {
  return std::abs(v.x) + std::abs(v.y) + std::abs(v.z);
}

constexpr double unit = rounding_bound(4);

struct Plane {
  std::array<Vec3d, 4> corners;
  Vec3d n;
  double offset;  ///< from the origin
  /// No plane whose offset differs by more than this is the same: the corners, which lie this close
  /// to it, allow neither more distance nor more tilt.
  double reach;

  explicit Plane(const Parallelogram& s) {
    const Vec3d o(s.origin), u(s.u), v(s.v);
    corners = {o, o + u, o + v, o + u + v};
    n = glm::normalize(glm::cross(u, v));
    offset = std::abs(glm::dot(n, o));
    double largest = 0;
    for (const Vec3d& p : corners)
      largest = std::max(largest, coordinates_of(p));
    const double gap = 2.1 * unit * largest;
    const double tilt = 2 * gap * (glm::length(u) + glm::length(v)) / glm::length(glm::cross(u, v));
    reach = gap + 2 * tilt * glm::length(o);
    if (!std::isfinite(reach)) reach = std::numeric_limits<double>::infinity();
  }
};

/// How far `points` lie from the plane; below 0 if that is more than rounding explains.
double gap_to(const std::array<Vec3d, 4>& points, const Plane& plane) {
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
  std::multimap<double, std::size_t> by_offset;  // of the firsts
  for (std::uint32_t i = 0; i < parallelograms.size(); ++i) {
    const Plane plane(parallelograms[i]);
    Planes::Entry entry{i, 0};  // also for one without area, which has no plane
    const auto end = by_offset.upper_bound(plane.offset + plane.reach);
    for (auto near = by_offset.lower_bound(plane.offset - plane.reach); near != end; ++near) {
      const auto& [first, other] = firsts[near->second];
      if (first > entry.first) continue;
      const double there = gap_to(plane.corners, other);
      if (there < 0) continue;
      const double back = gap_to(other.corners, plane);
      if (back < 0) continue;
      entry = {first, std::max(there, back)};
    }
    if (entry.first == i && std::isfinite(plane.offset)) {
      by_offset.emplace(plane.offset, firsts.size());
      firsts.emplace_back(i, plane);
    }
    planes.of.push_back(entry);
  }
  return planes;
}

}  // namespace carlo
