#include "scene/transforms.h"

#include "scene/properties.h"
#include "scene/text.h"

#include <glm/gtc/matrix_transform.hpp>

#include <cmath>

namespace carlo {
namespace {

double optional_number(const XmlElement& step, std::string_view attribute, double otherwise) {
  const XmlAttribute* found = step.find(attribute);
  return found != nullptr ? number_of(*found) : otherwise;
}

glm::dmat4 translation(const XmlElement& step) {
  step.allow_only({"x", "y", "z"});
  return glm::translate(glm::dmat4(1),
                        {optional_number(step, "x", 0), optional_number(step, "y", 0),
                         optional_number(step, "z", 0)});
}

glm::dmat4 rotation(const XmlElement& step) {
  step.allow_only({"x", "y", "z", "angle"});
  const glm::dvec3 axis{optional_number(step, "x", 0), optional_number(step, "y", 0),
                        optional_number(step, "z", 0)};
  if (!(glm::length(axis) > 0)) fail(step.at, "<rotate> needs an axis: x, y, z are all 0");
  return glm::rotate(glm::dmat4(1), glm::radians(number_of(step.get("angle"))), axis);
}

glm::dmat4 scaling(const XmlElement& step) {
  step.allow_only({"value", "x", "y", "z"});
  if (step.find("value") != nullptr && step.attributes.size() > 1) {
    fail(step.at, "<scale> takes either value or x, y, z, got both");
  }
  if (step.attributes.empty()) fail(step.at, "<scale> needs the attribute value, or x, y, z");
  for (const XmlAttribute& a : step.attributes) {
    if (number_of(a) == 0) fail(a.value_at, "a scale of 0 leaves nothing of the object");
  }
  const double all = optional_number(step, "value", 1);
  return glm::scale(glm::dmat4(1),
                    {optional_number(step, "x", all), optional_number(step, "y", all),
                     optional_number(step, "z", all)});
}

glm::dvec3 triple(const XmlAttribute& attribute) {
  const auto parts = words(attribute.value, ",");
  glm::dvec3 out{0};
  for (std::size_t i = 0; i < 3; ++i) {
    const auto number = parts.size() == 3 ? parse_number(parts[i]) : std::nullopt;
    if (!number) {
      fail(attribute.value_at, "{} must be three finite numbers, got {}", attribute.name,
           in_quotes(attribute.value));
    }
    out[static_cast<int>(i)] = *number;
  }
  return out;
}

// Local +z goes from origin to target, local +y lies with it and `up` in one plane, local +x points
// to the left of someone who looks that way.
glm::dmat4 look_at(const XmlElement& step) {
  step.allow_only({"origin", "target", "up"});
  const glm::dvec3 origin = triple(step.get("origin"));
  const glm::dvec3 forward = triple(step.get("target")) - origin;
  const glm::dvec3 up = step.find("up") != nullptr ? triple(*step.find("up")) : glm::dvec3(0, 1, 0);
  if (!(glm::length(forward) > 0)) fail(step.at, "<lookat>: origin and target are the same point");
  if (!(glm::length(up) > 0)) fail(step.at, "<lookat>: up is 0");
  const glm::dvec3 z = glm::normalize(forward);
  const glm::dvec3 left = glm::cross(glm::normalize(up), z);
  if (!(glm::length(left) > 1e-7)) {
    fail(step.at, "<lookat>: up is parallel to the direction of view");
  }
  const glm::dvec3 x = glm::normalize(left);
  const glm::dvec3 y = glm::cross(z, x);
  return {glm::dvec4(x, 0), glm::dvec4(y, 0), glm::dvec4(z, 0), glm::dvec4(origin, 1)};
}

glm::dmat4 matrix(const XmlElement& step) {
  step.allow_only({"value"});
  const XmlAttribute& value = step.get("value");
  const auto parts = words(value.value, ",");
  if (parts.size() != 16) {
    fail(value.value_at, "a matrix has 16 numbers (4 rows of 4), got {}", parts.size());
  }
  glm::dmat4 out(1);
  for (std::size_t i = 0; i < 16; ++i) {
    const auto row = static_cast<int>(i / 4), column = static_cast<int>(i % 4);
    const auto number = parse_number(parts[i]);
    if (!number) {
      fail(value.value_at, "a matrix has finite numbers, got {} in row {}, column {}",
           in_quotes(parts[i]), row + 1, column + 1);
    }
    out[column][row] = *number;
  }
  if (out[0][3] != 0 || out[1][3] != 0 || out[2][3] != 0 || out[3][3] != 1) {
    fail(value.value_at, "the last row of a matrix must be 0 0 0 1 (no projective transforms)");
  }
  return out;
}

glm::dmat4 parse_step(const XmlElement& step) {
  if (!step.children.empty()) {
    fail(step.children.front().at, "<{}> takes no elements inside", step.name);
  }
  if (step.name == "translate") return translation(step);
  if (step.name == "rotate") return rotation(step);
  if (step.name == "scale") return scaling(step);
  if (step.name == "lookat") return look_at(step);
  if (step.name == "matrix") return matrix(step);
  fail(step.at, "<{}> is not a step of a <transform>{}", step.name,
       suggest(step.name, {"translate", "rotate", "scale", "lookat", "matrix"}));
}

// Compares the determinant with the lengths of the columns, so that a small object is not taken for
// a flat one.
void check_invertible(const glm::dmat4& m, Position at) {
  const glm::dmat3 linear(m);
  const double lengths = glm::length(linear[0]) * glm::length(linear[1]) * glm::length(linear[2]);
  const double determinant = glm::determinant(linear);
  if (!std::isfinite(lengths) || !std::isfinite(determinant) ||
      !std::isfinite(glm::dot(m[3], m[3]))) {
    fail(at, "the transform's numbers are too large");
  }
  if (!(std::abs(determinant) > 1e-10 * lengths)) {
    fail(at, "the transform is singular: it flattens the object");
  }
}

Vec3 narrowed(glm::dvec3 v, Position at) {
  const Vec3 out(v);
  if (!(std::isfinite(out.x) && std::isfinite(out.y) && std::isfinite(out.z))) {
    fail(at, "a coordinate is not finite after toWorld: ({}, {}, {})", v.x, v.y, v.z);
  }
  return out;
}

}  // namespace

glm::dmat4 parse_transform(const XmlElement& element) {
  element.allow_only({"name"});
  glm::dmat4 all(1);
  for (const XmlElement& step : element.children) {
    const glm::dmat4 next = parse_step(step);
    check_invertible(next, step.at);
    all = next * all;
  }
  check_invertible(all, element.at);
  return all;
}

bool mirrors(const glm::dmat4& transform) {
  return glm::determinant(glm::dmat3(transform)) < 0;
}

Vec3 transform_point(const glm::dmat4& transform, glm::dvec3 p, Position at) {
  return narrowed(glm::dvec3(transform * glm::dvec4(p, 1)), at);
}

Vec3 transform_vector(const glm::dmat4& transform, glm::dvec3 v, Position at) {
  return narrowed(glm::dvec3(transform * glm::dvec4(v, 0)), at);
}

bool equal_and_orthogonal(glm::dvec3 a, glm::dvec3 b) {
  constexpr double tolerance = 1e-4;
  const double la = glm::length(a), lb = glm::length(b);
  return std::abs(la - lb) <= tolerance * lb && std::abs(glm::dot(a, b)) <= tolerance * la * lb;
}

}  // namespace carlo
