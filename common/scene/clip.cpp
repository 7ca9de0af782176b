#include "scene/clip.h"

#include "scene/match.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace carlo {
namespace {

using Vec3d = glm::dvec3;

/// The distance of p from a triangle: from its plane above its inside, otherwise from its edges.
double to_triangle(Vec3d p, const std::array<Vec3d, 3>& corner) {
  const Vec3d normal = glm::cross(corner[1] - corner[0], corner[2] - corner[0]);
  double nearest = std::numeric_limits<double>::infinity();
  bool inside = true;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3d a = corner[i], edge = corner[(i + 1) % 3] - a;
    inside = inside && glm::dot(glm::cross(edge, p - a), normal) >= 0;
    const double t = std::clamp(glm::dot(p - a, edge) / glm::dot(edge, edge), 0.0, 1.0);
    nearest = std::min(nearest, glm::length(p - a - t * edge));
  }
  return inside ? std::abs(glm::dot(p - corner[0], normal)) / glm::length(normal) : nearest;
}

double to_parallelogram(Vec3d p, const Parallelogram& s) {
  const Vec3d o(s.origin), u(s.u), v(s.v);
  return std::min(to_triangle(p, {o, o + u, o + v}), to_triangle(p, {o + u + v, o + v, o + u}));
}

double to_disk(Vec3d p, const Disk& s) {
  const Vec3d n(s.normal), d = p - Vec3d(s.center);
  const double above = glm::dot(d, n), across = glm::length(d - above * n);
  return std::hypot(above, std::max(across - static_cast<double>(s.radius), 0.0));
}

double to_mesh(Vec3d p, const Mesh& s) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const glm::uvec3& t : s.triangles) {
    nearest = std::min(nearest, to_triangle(p, {Vec3d(s.positions[t.x]), Vec3d(s.positions[t.y]),
                                                Vec3d(s.positions[t.z])}));
  }
  return nearest;
}

/// A lower bound on the distance of the nearest surface from p.
double clearance(Vec3d p, const Shape& shape) {
  return match(
      shape.geometry, [&](const Parallelogram& s) { return to_parallelogram(p, s); },
      [&](const Sphere& s) {
        return std::abs(glm::length(p - Vec3d(s.center)) - static_cast<double>(s.radius));
      },
      [&](const Disk& s) { return to_disk(p, s); }, [&](const Mesh& s) { return to_mesh(p, s); },
      [&](const Sdf& s) { return std::abs(sdf::distance(s, p)); });
}

/// An upper bound on how far a shape reaches along `forward` from p.
double reach(Vec3d p, Vec3d forward, const Shape& shape) {
  const auto depth = [&](Vec3d q) { return glm::dot(q - p, forward); };
  return match(
      shape.geometry,
      [&](const Parallelogram& s) {
        const Vec3d o(s.origin), u(s.u), v(s.v);
        return std::max({depth(o), depth(o + u), depth(o + v), depth(o + u + v)});
      },
      [&](const Sphere& s) { return depth(Vec3d(s.center)) + static_cast<double>(s.radius); },
      [&](const Disk& s) {
        const double across = glm::length(glm::cross(forward, Vec3d(s.normal)));
        return depth(Vec3d(s.center)) + static_cast<double>(s.radius) * across;
      },
      [&](const Mesh& s) {
        double most = -std::numeric_limits<double>::infinity();
        for (const glm::uvec3& t : s.triangles) {
          for (const unsigned i : {t.x, t.y, t.z})
            most = std::max(most, depth(Vec3d(s.positions[i])));
        }
        return most;
      },
      [&](const Sdf& s) {
        const sdf::Box box = sdf::bounds(s, s.place);
        return depth(0.5 * (box.lower + box.upper)) +
               0.5 * glm::dot(box.upper - box.lower, glm::abs(forward));
      });
}

}  // namespace

void check_clip(const Scene& scene, const ClipRange& clip, SceneErrors& errors) {
  const Camera& camera = scene.camera;
  const Vec3d eye(camera.origin), forward(camera.forward);
  double nearest = std::numeric_limits<double>::infinity(), farthest = 0;
  for (const Shape& shape : scene.shapes) {
    if (clip.near_clip) nearest = std::min(nearest, clearance(eye, shape));
    if (clip.far_clip) farthest = std::max(farthest, reach(eye, forward, shape));
  }
  const double x = camera.tan_half_x, y = camera.tan_half_y;
  if (clip.near_clip && nearest < *clip.near_clip * std::sqrt(1 + x * x + y * y)) {
    errors.guard([&] {
      fail(clip.near_at,
           "nearClip {} may cut what is {:.4g} from the camera; nothing is cut here: make it less",
           *clip.near_clip, nearest);
    });
  }
  if (clip.far_clip && farthest > *clip.far_clip) {
    errors.guard([&] {
      fail(clip.far_at,
           "farClip {} cuts what is up to {:.4g} deep; nothing is cut here: make it more",
           *clip.far_clip, farthest);
    });
  }
}

}  // namespace carlo
