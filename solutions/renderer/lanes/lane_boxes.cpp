#include "renderer/lanes/lane_boxes.h"

#include "geometry/planes.h"
#include "renderer/lanes/lane_plan.h"
#include "scene/match.h"
#include "scene/needs.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <utility>

namespace renderer {
namespace {

using carlo::Parallelogram;
using carlo::Scene;
using Vec3d = glm::dvec3;

constexpr double tolerance = 1e-6;
/// An enclosure with fewer sides costs more than its sides tested one by one.
constexpr int least_sides = 4;

struct Parallelepiped {
  Vec3d origin;
  std::array<Vec3d, 3> edge;
  double size;  ///< its largest coordinate, which rounding is relative to

  Vec3d corner(unsigned i) const {
    Vec3d p = origin;
    for (unsigned k = 0; k < 3; ++k)
      p += static_cast<double>(i >> k & 1) * edge[k];
    return p;
  }
};

const Parallelogram* parallelogram(const Scene& scene, std::size_t i) {
  using Result = const Parallelogram*;
  return carlo::match(
      scene.shapes[i].geometry, [](const Parallelogram& quad) -> Result { return &quad; },
      [](const carlo::Disk&) -> Result { return nullptr; },
      [](const carlo::Sphere&) -> Result { return nullptr; },
      [](const carlo::Mesh&) -> Result { return nullptr; },
      [](const carlo::Sdf&) -> Result { return nullptr; });
}

int common_corners(const Parallelogram& a, const Parallelogram& b, double near) {
  int common = 0;
  for (const Vec3d& p : corners(a)) {
    for (const Vec3d& q : corners(b))
      common += glm::length(p - q) <= near;
  }
  return common;
}

/// The box that has `a` and `b`, which shares an edge with it, among its sides, if there is one.
std::optional<Parallelepiped> spanned(const Parallelogram& a, const Parallelogram& b) {
  double size = 0;
  for (const Parallelogram* quad : {&a, &b}) {
    for (const Vec3d& p : corners(*quad))
      size = std::max({size, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  }
  const double near = tolerance * size;
  if (common_corners(a, b, near) != 2) return std::nullopt;
  const Vec3d u(a.u), v(a.v), n = glm::normalize(glm::cross(u, v));
  const auto low = [&](const Vec3d& p) { return std::abs(glm::dot(n, p - Vec3d(a.origin))); };
  // The one of b's edges that leaves a's plane.
  for (const Vec3d& w : {Vec3d(b.u), Vec3d(b.v)}) {
    if (!(std::abs(glm::dot(n, w)) > near)) continue;
    const Vec3d from = low(Vec3d(b.origin)) <= near ? w : -w;
    const Parallelepiped box{Vec3d(a.origin), {u, v, from}, size};
    return box;
  }
  return std::nullopt;
}

/// The side of the box (0 to 5, as in LaneBox::faces) that the parallelogram forms.
std::optional<unsigned> side(const Parallelepiped& box, const Parallelogram& quad) {
  const auto points = corners(quad);
  for (unsigned f = 0; f < 6; ++f) {
    unsigned found = 0;
    for (unsigned i = 0; i < 8; ++i) {
      if ((i >> (f / 2) & 1) != (f & 1)) continue;
      const Vec3d p = box.corner(i);
      found += std::any_of(points.begin(), points.end(), [&](const Vec3d& q) {
        return glm::length(p - q) <= tolerance * box.size;
      });
    }
    if (found == 4) return f;
  }
  return std::nullopt;
}

LaneBox slabs(const Parallelepiped& box) {
  LaneBox result;
  const Vec3d middle = box.origin + 0.5 * (box.edge[0] + box.edge[1] + box.edge[2]);
  for (unsigned k = 0; k < 3; ++k) {
    Vec3d n = glm::normalize(glm::cross(box.edge[(k + 1) % 3], box.edge[(k + 2) % 3]));
    if (glm::dot(n, box.edge[k]) < 0) n = -n;
    result.axis[k] = {static_cast<float>(n.x), static_cast<float>(n.y), static_cast<float>(n.z)};
    result.center[k] = static_cast<float>(glm::dot(n, middle));
    result.half[k] = static_cast<float>(0.5 * glm::dot(n, box.edge[k]));
  }
  result.upright = std::all_of(result.axis.begin(), result.axis.end(), [](const auto& axis) {
    return std::count(axis.begin(), axis.end(), 0.0f) == 2;
  });
  return result;
}

FoundBox gather_sides(const Scene& scene, const Parallelepiped& box,
                      const std::vector<std::size_t>& candidates) {
  FoundBox found{slabs(box), {}};
  for (const std::size_t i : candidates) {
    const auto f = side(box, *parallelogram(scene, i));
    if (!f || found.shape[*f]) continue;
    found.shape[*f] = i;
    found.box.faces |= 1u << *f;
  }
  return found;
}

/// The distance of p from the nearest of the given faces of the box (bits as in LaneBox::faces) on
/// their inner side; below 0 if it is on the outer side of one.
double depth_inside(const LaneBox& box, const Vec3d& p, std::uint32_t faces = 0x3F) {
  double least = std::numeric_limits<double>::infinity();
  for (unsigned f = 0; f < 6; ++f) {
    if ((faces >> f & 1) == 0) continue;
    const unsigned k = f / 2;
    const Vec3d n(box.axis[k][0], box.axis[k][1], box.axis[k][2]);
    const double along = glm::dot(n, p) - static_cast<double>(box.center[k]);
    least = std::min(least, static_cast<double>(box.half[k]) + ((f & 1) != 0 ? -along : along));
  }
  return least;
}

/// True if all shapes lie in the box and the camera does not see the outer side of its sides.
bool holds(const LaneBox& box, const Scene& scene) {
  const Vec3d camera(scene.camera.origin);
  if (!(depth_inside(box, camera, box.faces) > tolerance * glm::length(camera))) return false;
  const auto inside = [&](const Vec3d& p) {
    const double size = std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z), 1e-30});
    return depth_inside(box, p) >= -tolerance * size;
  };
  const auto holds_quad = [&](const Parallelogram& quad) {
    const auto points = corners(quad);
    return std::all_of(points.begin(), points.end(), inside);
  };
  // A light just outside would be hidden by the wall, which casts no shadow.
  const auto& [lights, environment, envmap] = scene.lights;
  (void)environment;  // nothing is behind a missing wall
  if (envmap) return false;
  for (const carlo::PointLight& light : lights) {
    const Vec3d p(light.position);
    if (!(depth_inside(box, p) > tolerance * glm::length(p))) return false;
  }
  return std::all_of(scene.shapes.begin(), scene.shapes.end(), [&](const carlo::Shape& shape) {
    return carlo::match(
        shape.geometry, holds_quad,
        [&](const carlo::Disk& disk) { return holds_quad(square_around(disk)); },
        [&](const carlo::Sphere& sphere) {
          const auto r = static_cast<double>(sphere.radius);
          return depth_inside(box, Vec3d(sphere.center)) >= r * (1 - tolerance);
        },
        [&](const carlo::Mesh& mesh) {
          return std::all_of(mesh.positions.begin(), mesh.positions.end(),
                             [&](const carlo::Vec3& p) { return inside(Vec3d(p)); });
        },
        [&](const carlo::Sdf& sdf) {
          const auto [lower, upper] = carlo::sdf::bounds(sdf, sdf.place);
          for (unsigned i = 0; i < 8; ++i) {
            const Vec3d corner((i & 1) != 0 ? upper.x : lower.x, (i & 2) != 0 ? upper.y : lower.y,
                               (i & 4) != 0 ? upper.z : lower.z);
            if (!inside(corner)) return false;
          }
          return true;
        });
  });
}

bool dark(const Scene& scene, const FoundBox& box) {
  return std::none_of(box.shape.begin(), box.shape.end(),
                      [&](const auto& i) { return i && scene.shapes[*i].emits(); });
}

/// The interval that points or a ball cover along an axis.
struct Interval {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  void add(double x) { low = std::min(low, x), high = std::max(high, x); }
};
Interval along(const Vec3d& axis, const carlo::Shape& shape) {
  Interval result;
  const auto of_quad = [&](const Parallelogram& quad) {
    for (const Vec3d& p : corners(quad))
      result.add(glm::dot(axis, p));
  };
  carlo::match(
      shape.geometry, of_quad, [&](const carlo::Disk& disk) { of_quad(square_around(disk)); },
      [&](const carlo::Sphere& sphere) {
        const double middle = glm::dot(axis, Vec3d(sphere.center)), r = sphere.radius;
        result.add(middle - r), result.add(middle + r);
      },
      [&](const carlo::Mesh& mesh) {
        for (const carlo::Vec3& p : mesh.positions)
          result.add(glm::dot(axis, Vec3d(p)));
      },
      [&](const carlo::Sdf&) {  // does not emit
        result.add(-std::numeric_limits<double>::infinity());
        result.add(std::numeric_limits<double>::infinity());
      });
  return result;
}

/// True if a light may reach into the box, that is, no plane along a side separates them. The ends
/// of shadow rays must lie outside solids.
bool lit_inside(const Scene& scene, const LaneBox& box) {
  const auto part = [&](const auto& interval_along) {
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3d axis(box.axis[k][0], box.axis[k][1], box.axis[k][2]);
      const Interval light = interval_along(axis);
      const double center = box.center[k], half = box.half[k];
      const double near = tolerance * (std::abs(center) + half);
      if (light.low >= center + half - near || light.high <= center - half + near) return true;
    }
    return false;
  };
  const auto& [points, environment, envmap] = scene.lights;
  (void)environment, (void)envmap;  // surround the scene
  return std::any_of(scene.shapes.begin(), scene.shapes.end(),
                     [&](const carlo::Shape& shape) {
                       return shape.emits() &&
                              !part([&](const Vec3d& axis) { return along(axis, shape); });
                     }) ||
         std::any_of(points.begin(), points.end(), [&](const carlo::PointLight& light) {
           return !part([&](const Vec3d& axis) {
             const double x = glm::dot(axis, Vec3d(light.position));
             return Interval{x, x};
           });
         });
}

/// True if two parallelograms of one plane share more than edges: no line along an edge of either
/// separates them.
bool overlap(const Parallelogram& a, const Parallelogram& b) {
  const Vec3d n = glm::cross(Vec3d(a.u), Vec3d(a.v));
  const auto p = corners(a), q = corners(b);
  for (const Vec3d& edge : {Vec3d(a.u), Vec3d(a.v), Vec3d(b.u), Vec3d(b.v)}) {
    const Vec3d across = glm::cross(n, edge);
    const auto extent = [&](const auto& points) {
      std::pair<double, double> range{std::numeric_limits<double>::infinity(),
                                      -std::numeric_limits<double>::infinity()};
      for (const Vec3d& point : points) {
        range.first = std::min(range.first, glm::dot(across, point));
        range.second = std::max(range.second, glm::dot(across, point));
      }
      return range;
    };
    const auto [low_a, high_a] = extent(p);
    const auto [low_b, high_b] = extent(q);
    const double margin = tolerance * std::min(high_a - low_a, high_b - low_b);
    if (low_b >= high_a - margin || low_a >= high_b - margin) return false;
  }
  return true;
}

/// True if a front face in the plane of some side looks out of the box: either another shape covers
/// the side, so that it matters which one is met, or the side itself is black from outside.
bool covered(const Scene& scene, const FoundBox& box, const std::vector<std::size_t>& quads) {
  const auto looks_out = [](const Parallelogram& quad, const LaneBox& slabs, unsigned f) {
    const auto& axis = slabs.axis[f / 2];
    const double along =
        glm::dot(glm::cross(Vec3d(quad.u), Vec3d(quad.v)), Vec3d(axis[0], axis[1], axis[2]));
    return (along > 0) == ((f & 1) != 0);
  };
  for (unsigned f = 0; f < 6; ++f) {
    if (!box.shape[f]) continue;
    const carlo::Shape& side = scene.shapes[*box.shape[f]];
    const auto& face = std::get<Parallelogram>(side.geometry);
    if (!scene.materials[side.material].two_sided && !looks_out(face, box.box, f)) return true;
    for (const std::size_t i : quads) {
      if (std::find(box.shape.begin(), box.shape.end(), i) != box.shape.end()) continue;
      const Parallelogram& quad = *parallelogram(scene, i);
      const std::array<Parallelogram, 2> both{face, quad};
      if (looks_out(quad, box.box, f) && carlo::find_planes(both).of[1].first == 0 &&
          overlap(face, quad)) {
        return true;
      }
    }
  }
  return false;
}

void remove_sides(std::vector<std::size_t>& quads, const FoundBox& box) {
  for (const auto& i : box.shape)
    if (i) std::erase(quads, *i);
}

/// The box with the most sides among those that have the parallelogram `first` as a side.
FoundBox largest_box(const Scene& scene, std::size_t first, const std::vector<std::size_t>& quads) {
  FoundBox best;
  for (const std::size_t i : quads) {
    if (i == first) continue;
    const auto box = spanned(*parallelogram(scene, first), *parallelogram(scene, i));
    if (!box) continue;
    const FoundBox found = gather_sides(scene, *box, quads);
    if (std::popcount(found.box.faces) > std::popcount(best.box.faces)) best = found;
  }
  return best;
}

}  // namespace

LaneBoxes find_boxes(const Scene& scene) {
  LaneBoxes result;
  std::vector<std::size_t> quads;
  for (std::size_t i = 0; i < scene.shapes.size(); ++i) {
    if (parallelogram(scene, i) == nullptr) continue;
    // Glass lets paths through to the other side.
    (carlo::passes_light(scene.materials[scene.shapes[i].material]) ? result.others : quads)
        .push_back(i);
  }
  const Vec3d camera(scene.camera.origin);
  for (std::vector<std::size_t> left = quads; !left.empty();) {
    const std::size_t first = left.front();
    const FoundBox box = largest_box(scene, first, quads);
    const int sides = std::popcount(box.box.faces);
    const double size = glm::length(camera);
    if (!result.enclosure && sides >= least_sides && holds(box.box, scene)) {
      result.enclosure = box;
      result.camera_inside = depth_inside(box.box, camera) > tolerance * size;
    } else if (sides == 6 && dark(scene, box) && !lit_inside(scene, box.box) &&
               depth_inside(box.box, camera) < -tolerance * size) {
      result.solids.push_back(box);
    } else {
      result.others.push_back(first);
      std::erase(left, first);
      continue;
    }
    remove_sides(left, box);
    remove_sides(quads, box);
  }
  std::vector<FoundBox> solids;
  std::swap(solids, result.solids);
  for (const FoundBox& box : solids) {
    if (!covered(scene, box, result.others)) {
      result.solids.push_back(box);
      continue;
    }
    for (const auto& i : box.shape)
      result.others.push_back(*i);
  }
  return result;
}

}  // namespace renderer
