#include "scene/shapes.h"

#include "scene/transforms.h"

#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

namespace carlo {
namespace {

// The square with corner `origin` and edges u, v, with its normal along u x v in local coordinates.
Parallelogram parallelogram(Properties& shape, glm::dvec3 origin, glm::dvec3 u, glm::dvec3 v) {
  const glm::dmat4 to_world = shape.to_world();
  const bool flipped = shape.boolean("flipNormals").value_or(false);
  const Position at = shape.at("toWorld");
  Parallelogram out{transform_point(to_world, origin, at), transform_vector(to_world, u, at),
                    transform_vector(to_world, v, at)};
  // A normal is transformed by the inverse transpose, which is u' x v' up to the determinant's
  // sign.
  if (mirrors(to_world) != flipped) std::swap(out.u, out.v);
  if (is_degenerate(out.u, out.v)) {
    fail(at, "the {} has no area (too small or too thin)", shape.type());
  }
  return out;
}

std::vector<Geometry> parse_cube(Properties& shape) {
  std::vector<Geometry> faces;
  for (int axis = 0; axis < 3; ++axis) {
    for (const double side : {-1.0, 1.0}) {
      glm::dvec3 normal{0}, u{0}, v{0};
      normal[axis] = side;
      u[(axis + (side > 0 ? 1 : 2)) % 3] = 2;
      v[(axis + (side > 0 ? 2 : 1)) % 3] = 2;
      faces.emplace_back(parallelogram(shape, normal - 0.5 * (u + v), u, v));
    }
  }
  return faces;
}

Sphere parse_sphere(Properties& shape) {
  const glm::dvec3 center = shape.point("center").value_or(glm::dvec3(0));
  const float radius = shape.number("radius").value_or(1.0f);
  const glm::dmat4 to_world = shape.to_world();
  // A mirrored sphere keeps its outside in Mitsuba 0.6; Mitsuba 3 turns it inside out.
  const bool mirrored = shape.dialect() == Dialect::mitsuba3 && mirrors(to_world);
  const bool flipped = shape.boolean("flipNormals").value_or(false) != mirrored;
  const glm::dmat3 linear(to_world);
  const Position at = shape.at("toWorld");
  if (!equal_and_orthogonal(linear[0], linear[1]) || !equal_and_orthogonal(linear[1], linear[2]) ||
      !equal_and_orthogonal(linear[2], linear[0])) {
    fail(at, "non-uniform scale of a sphere is not supported");
  }
  const double scale = std::cbrt(std::abs(glm::determinant(linear)));
  const auto scaled = static_cast<float>(scale * static_cast<double>(radius));
  if (!(scaled > 0) || !std::isfinite(scaled)) {
    fail(at, "the sphere's radius after toWorld is {}, out of float's range", scaled);
  }
  return {transform_point(to_world, center, at), scaled, flipped};
}

// The disk of radius 1 about the origin in the plane z = 0, normal +z.
Disk parse_disk(Properties& shape) {
  const glm::dmat4 to_world = shape.to_world();
  const bool flipped = shape.boolean("flipNormals").value_or(false);
  const Position at = shape.at("toWorld");
  const glm::dvec3 x(to_world[0]), y(to_world[1]);
  if (!equal_and_orthogonal(x, y)) fail(at, "non-uniform scale of a disk is not supported");
  const glm::dvec3 normal = glm::normalize(glm::cross(x, y));
  const auto radius = static_cast<float>(std::sqrt(glm::length(x) * glm::length(y)));
  if (!(radius > 0) || !std::isfinite(radius)) {
    fail(at, "the disk's radius after toWorld is {}, out of float's range", radius);
  }
  const bool turned = mirrors(to_world) != flipped;
  return {transform_point(to_world, glm::dvec3(0), at), Vec3(turned ? -normal : normal), radius};
}

}  // namespace

std::vector<Geometry> parse_geometry(Properties& shape, std::vector<std::string>& notes,
                                     SceneErrors& errors) {
  const std::string type = shape.type();
  if (type == "rectangle") return {parallelogram(shape, {-1, -1, 0}, {2, 0, 0}, {0, 2, 0})};
  if (type == "cube") return parse_cube(shape);
  if (type == "sphere") return {parse_sphere(shape)};
  if (type == "disk") return {parse_disk(shape)};
  if (type == "obj" || type == "ply") return {parse_mesh(shape, notes)};
  if (type == "sdf") return {parse_sdf(shape, errors)};
  throw std::logic_error("no geometry is made of the shape " + type);
}

bool is_degenerate(Vec3 edge1, Vec3 edge2) {
  // In double: the square of a float product of edges leaves float's range below 1e-10 and above
  // 1e10. The area itself must be a float. Written so that NaN, from 0/0 or from overflow, fails.
  const double area = glm::length(glm::cross(glm::dvec3(edge1), glm::dvec3(edge2)));
  constexpr double least = std::numeric_limits<float>::min(),
                   most = std::numeric_limits<float>::max();
  return !(area >= least && area <= most);
}

}  // namespace carlo
