#include "scene/mesh_file.h"

#include "numeric/vec.h"
#include "support/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace carlo {
namespace {

using Point = glm::dvec2;
using Points = std::vector<glm::dvec3>;
using Corner = std::uint32_t;

/// For a polygon that no fan fits, the time is quadratic in its corners: a second for this many.
constexpr std::size_t most_corners = 10000;

/// Twice the area of a triangle, positive when it is counter-clockwise.
double turn(Point a, Point b, Point c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// Twice the vector area.
glm::dvec3 normal_of(const Points& points) {
  glm::dvec3 sum(0);
  for (std::size_t i = 2; i < points.size(); ++i)
    sum += glm::cross(points[i - 1] - points[0], points[i] - points[0]);
  return sum;
}

/// Projects along the axis nearest to the normal, so that no coordinate is rounded;
/// counter-clockwise.
std::vector<Point> projected(const Points& points) {
  const glm::dvec3 n = normal_of(points), size = glm::abs(n);
  const int axis = size.x > std::max(size.y, size.z) ? 0 : size.y > size.z ? 1 : 2;
  const int x = (axis + 1) % 3, y = (axis + 2) % 3;
  std::vector<Point> flat;
  flat.reserve(points.size());
  for (const glm::dvec3& p : points)
    flat.push_back(n[axis] > 0 ? Point(p[x], p[y]) : Point(p[y], p[x]));
  return flat;
}

/// True if two edges cross, with each end further than `least` from the other edge.
bool cross(Point a, Point b, Point c, Point d, double least) {
  if (std::max(a.x, b.x) < std::min(c.x, d.x) || std::max(c.x, d.x) < std::min(a.x, b.x))
    return false;
  const auto apart = [least](Point p, Point q, Point r, Point s) {
    const double far = least * std::max(std::abs(q.x - p.x), std::abs(q.y - p.y));
    const double at_r = turn(p, q, r), at_s = turn(p, q, s);
    return (at_r < -far && at_s > far) || (at_r > far && at_s < -far);
  };
  return apart(a, b, c, d) && apart(c, d, a, b);
}

/// Touching does not count: rounding to float makes edges cross that only touch.
bool crosses_itself(const std::vector<Point>& points) {
  Point lower = points[0], upper = points[0];
  for (const Point& p : points)
    lower = glm::min(lower, p), upper = glm::max(upper, p);
  const double least = 0x1p-22 * std::max(upper.x - lower.x, upper.y - lower.y);
  const std::size_t n = points.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Point a = points[i], b = points[(i + 1) % n];
    for (std::size_t k = i + 2; k < n; ++k) {
      if (cross(a, b, points[k], points[(k + 1) % n], least)) return true;
    }
  }
  return false;
}

/// Cuts off ears: corners whose triangle holds nothing else of the polygon. Every polygon has two,
/// and cutting one leaves a polygon. Only its neighbours affect whether a corner is an ear. Source:
/// Meisters, "Polygons have ears", American Mathematical Monthly 82, 1975. Used instead of a
/// library: those in Debian 12 that cut polygons bring OpenGL (GLU), a geometry kernel (CGAL) or
/// scores of file readers (Assimp); tinyobjloader's cutter leaves holes.
class EarCutter {
 public:
  explicit EarCutter(const std::vector<Point>& points) : points_(points) {
    const auto n = static_cast<Corner>(points.size());
    for (Corner i = 0; i < n; ++i) {
      before_.push_back((i + n - 1) % n);
      after_.push_back((i + 1) % n);
    }
    for (Corner i = 0; i < n; ++i) {
      if (turn_at(i) <= 0) inner_.push_back(i);
    }
  }

  /// Returns false if no ear is left before the polygon is cut completely.
  bool cut(std::vector<glm::uvec3>& triangles) {
    triangles.clear();
    while (triangles.size() + 2 < points_.size()) {
      // Corners without area are cut when nothing else is left to cut.
      const std::size_t before = triangles.size();
      cut_ears(triangles, false);
      if (triangles.size() == before) cut_ears(triangles, true);
      if (triangles.size() == before) return false;
    }
    return true;
  }

 private:
  double turn_at(Corner i) const {
    return turn(points_[before_[i]], points_[i], points_[after_[i]]);
  }

  bool is_cut(Corner i) const { return after_[before_[i]] != i; }

  void cut_ears(std::vector<glm::uvec3>& triangles, bool flat) {
    std::vector<Corner> pending;
    for (Corner i = 0; i < points_.size(); ++i) {
      if (!is_cut(i)) pending.push_back(i);
    }
    for (std::size_t k = 0; k < pending.size() && triangles.size() + 2 < points_.size(); ++k) {
      const Corner i = pending[k], before = before_[i], after = after_[i];
      if (is_cut(i) || !(flat ? turn_at(i) == 0 : is_ear(i))) continue;
      triangles.emplace_back(before, i, after);
      after_[before] = after;
      before_[after] = before;
      if (flat) return;
      pending.insert(pending.end(), {before, after});
    }
  }

  bool is_ear(Corner i) {
    if (!(turn_at(i) > 0)) return false;
    const Point a = points_[before_[i]], b = points_[i], c = points_[after_[i]];
    const auto stopped_being = [this](Corner k) { return is_cut(k) || turn_at(k) > 0; };
    inner_.erase(std::remove_if(inner_.begin(), inner_.end(), stopped_being), inner_.end());
    return std::none_of(inner_.begin(), inner_.end(), [&](Corner k) {
      const Point p = points_[k];
      // Where a cut leads to a hole, several corners share a position.
      return p != a && p != b && p != c && turn(a, b, p) >= 0 && turn(b, c, p) >= 0 &&
             turn(c, a, p) >= 0;
    });
  }

  const std::vector<Point>& points_;
  std::vector<Corner> before_, after_;  ///< among the remaining corners
  std::vector<Corner> inner_;           ///< the reflex corners
};

/// True if the triangles (0, i - 1, i) make up the polygon: for convex polygons, and for those that
/// are entirely visible from their first corner. Also true for polygons without area up to
/// rounding, which are not worth a refusal.
bool fan_fits(const Points& points) {
  const glm::dvec3 n = normal_of(points);
  constexpr double nothing = 1e-12;  ///< relative to the area: rounding
  double area = 0, extent = 0;
  for (std::size_t i = 2; i < points.size(); ++i) {
    const glm::dvec3 a = points[i - 1] - points[0], b = points[i] - points[0];
    area += glm::length(glm::cross(a, b));
    extent = std::max({extent, glm::dot(a, a), glm::dot(b, b)});
  }
  // Thinner than the float rounding of its corners.
  if (area <= 0x1p-22 * extent) return true;
  // Each triangle has the same orientation, and together they do not go fully around the corner.
  const double least = -nothing * area * glm::length(n);
  bool behind = false;
  for (std::size_t i = 2; i < points.size(); ++i) {
    const glm::dvec3 b = points[i] - points[0];
    if (!(glm::dot(glm::cross(points[i - 1] - points[0], b), n) >= least)) return false;
    const bool now_behind = glm::dot(glm::cross(points[1] - points[0], b), n) < least;
    if (behind && !now_behind) return false;
    behind = now_behind;
  }
  return glm::length(n) > nothing * area;
}

/// Cuts a polygon into points.size() - 2 triangles of its orientation, given by the numbers of its
/// corners. A polygon that is not flat is cut as seen along its normal (its vector area). It may
/// touch itself, as where a cut leads to a hole; if its edges cross, or it has too many corners,
/// returns what is wrong.
std::optional<std::string> cut_into_triangles(const Points& points,
                                              std::vector<glm::uvec3>& triangles) {
  if (points.size() > most_corners) {
    return fmt::format("a face of {} corners that is not convex, expected {} at most",
                       points.size(), most_corners);
  }
  const std::vector<Point> flat = projected(points);
  if (crosses_itself(flat) || !EarCutter(flat).cut(triangles))
    return fmt::format("the edges of a face of {} corners cross", points.size());
  return std::nullopt;
}

}  // namespace

void add_face(MeshFile& mesh, std::span<const std::uint32_t> corners, std::size_t place,
              std::span<const std::uint32_t> normals) {
  if (!normals.empty()) mesh.normals_of.resize(mesh.triangles.size(), glm::uvec3(mesh.no_normal));
  if (corners.size() > 3) {
    mesh.polygons.push_back(
        {mesh.triangles.size(), mesh.polygon_corners.size(), corners.size(), place});
    mesh.polygon_corners.insert(mesh.polygon_corners.end(), corners.begin(), corners.end());
  }
  for (std::size_t i = 2; i < corners.size(); ++i) {
    mesh.triangles.emplace_back(corners[0], corners[i - 1], corners[i]);
    if (!normals.empty()) mesh.normals_of.emplace_back(normals[0], normals[i - 1], normals[i]);
  }
}

/// Returns the normals of a polygon's corners, which is a fan as yet; none if it has none.
static std::vector<std::uint32_t> normals_of(const MeshFile& mesh, const Polygon& polygon) {
  if (polygon.first_triangle >= mesh.normals_of.size()) return {};
  const glm::uvec3* const fan = &mesh.normals_of[polygon.first_triangle];
  std::vector<std::uint32_t> normals{fan[0].x, fan[0].y};
  for (std::size_t i = 0; i + 2 < polygon.corners; ++i)
    normals.push_back(fan[i].z);
  return normals;
}

void cut_polygons(MeshFile& mesh, const std::string& name, std::string_view place) {
  std::vector<glm::dvec3> points;
  std::vector<glm::uvec3> triangles;
  for (const Polygon& polygon : mesh.polygons) {
    const std::uint32_t* const corners = &mesh.polygon_corners[polygon.first_corner];
    points.clear();
    for (std::size_t i = 0; i < polygon.corners; ++i)
      points.push_back(mesh.positions[corners[i]]);
    if (fan_fits(points)) continue;
    if (const auto wrong = cut_into_triangles(points, triangles))
      throw Error("{}{}{}: {}", name, place, polygon.place, *wrong);
    const std::vector<std::uint32_t> normals = normals_of(mesh, polygon);
    for (std::size_t i = 0; i < triangles.size(); ++i) {
      const glm::uvec3 t = triangles[i];
      mesh.triangles[polygon.first_triangle + i] = {corners[t.x], corners[t.y], corners[t.z]};
      if (!normals.empty())
        mesh.normals_of[polygon.first_triangle + i] = {normals[t.x], normals[t.y], normals[t.z]};
    }
  }
}

}  // namespace carlo
