#include "scene/digits.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <variant>
#include <vector>

namespace carlo {
namespace {

using Vec3d = glm::dvec3;

constexpr double enough = 1000, touching = 8;  ///< in units of a plane's error
constexpr std::size_t most_things = 3000;      ///< all pairs are compared: this takes a second at
                                               ///< most

/// Something that may be close to a plane.
struct Thing {
  std::vector<Vec3d> points;
  double radius = 0;  ///< about its only point
  double size = 0;    ///< its shortest side; 0 if it has none
};

Thing thing_of(const Shape& shape) {
  struct Visitor {
    Thing operator()(const Parallelogram& s) const {
      const Vec3d o(s.origin), u(s.u), v(s.v);
      return {{o, o + u, o + v, o + u + v}, 0, std::min(glm::length(u), glm::length(v))};
    }
    Thing operator()(const Sphere& s) const {
      return {{Vec3d(s.center)}, static_cast<double>(s.radius), 2 * static_cast<double>(s.radius)};
    }
    Thing operator()(const Disk& s) const {
      return {{Vec3d(s.center)}, 0, 2 * static_cast<double>(s.radius)};
    }
    Thing operator()(const Mesh&) const { return {}; }
    Thing operator()(const Sdf&) const { return {}; }
  };
  return std::visit(Visitor{}, shape.geometry);
}

/// A parallelogram's plane in double, and the accuracy of its position in floats.
struct Plane {
  Vec3d o, u, v, n;
  double error = 0;  ///< 0 if it is parallel to a coordinate plane

  explicit Plane(const Parallelogram& s) : o(s.origin), u(s.u), v(s.v), n(glm::cross(u, v)) {
    const double area = glm::length(n);
    if (!(area > 0)) return;
    const Vec3d size = glm::abs(n);
    n /= area;
    if (std::max({size.x, size.y, size.z}) == size.x + size.y + size.z) return;
    for (const Vec3d& p : {o, o + u, o + v, o + u + v})
      error = std::max({error, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
    error *= 0x1p-24;
  }

  bool below(Vec3d p) const {
    const Vec3d q = p - o;
    const double square = glm::dot(glm::cross(u, v), n);
    const double a = glm::dot(glm::cross(q, v), n) / square;
    const double b = glm::dot(glm::cross(u, q), n) / square;
    return std::min(a, b) > -.01 && std::max(a, b) < 1.01;
  }

  /// The thing's distance, or its size where it touches, in units of the error.
  double digits(const Thing& thing) const {
    double least = enough;
    for (const Vec3d& p : thing.points) {
      if (!below(p)) continue;
      double far = std::abs(std::abs(glm::dot(p - o, n)) - thing.radius) / error;
      if (far <= touching) far = thing.size > 0 ? thing.size / error : enough;
      least = std::min(least, far);
    }
    return least;
  }
};

}  // namespace

std::optional<std::string> too_few_digits(const Scene& scene) {
  const auto& [points, environment, envmap] = scene.lights;
  (void)environment, (void)envmap;  // are near nothing
  if (scene.shapes.size() + points.size() > most_things) return std::nullopt;
  std::vector<Thing> things;
  for (const Shape& shape : scene.shapes)
    things.push_back(thing_of(shape));
  for (const PointLight& light : points)
    things.push_back({{Vec3d(light.position)}});
  double least = enough, error = 0;
  for (std::size_t i = 0; i < scene.shapes.size(); ++i) {
    const auto* parallelogram = std::get_if<Parallelogram>(&scene.shapes[i].geometry);
    if (parallelogram == nullptr) continue;
    const Plane plane(*parallelogram);
    if (!(plane.error > 0)) continue;
    for (std::size_t k = 0; k < things.size(); ++k) {
      const double digits = k == i ? enough : plane.digits(things[k]);
      if (digits < least) least = digits, error = plane.error;
    }
  }
  if (least == enough) return std::nullopt;
  return fmt::format(
      "floats place a parallelogram that is not parallel to a coordinate plane to {:.1g} only: too "
      "roughly for what is {:.1g} away from it, or touches it and has that size (Limits, "
      "common/scene/README.md)",
      error, least * error);
}

}  // namespace carlo
