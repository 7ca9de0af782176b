#include "scene/transforms.h"

#include "scene/text.h"
#include "scene/values.h"

#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <vector>

namespace carlo {
namespace {

double optional_number(const XmlElement& step, std::string_view attribute, double otherwise) {
  const XmlAttribute* found = step.find(attribute);
  return found != nullptr ? number_of(*found) : otherwise;
}

bool is_triple(const XmlAttribute& attribute) {
  return words(attribute.value, ",").size() == 3;
}

/// Mitsuba 0.6's x, y and z, or Mitsuba 3's value="x, y, z".
glm::dvec3 vector_of(const XmlElement& step, double otherwise) {
  if (const XmlAttribute* value = step.find("value")) {
    for (const char* axis : {"x", "y", "z"}) {
      if (step.find(axis) != nullptr) {
        fail(step.at, "<{}> takes either value or x, y, z, got both", step.name);
      }
    }
    return triple_of(*value);
  }
  return {optional_number(step, "x", otherwise), optional_number(step, "y", otherwise),
          optional_number(step, "z", otherwise)};
}

glm::dmat4 translation(const XmlElement& step) {
  return glm::translate(glm::dmat4(1), vector_of(step, 0));
}

glm::dmat4 rotation(const XmlElement& step) {
  const glm::dvec3 axis = vector_of(step, 0), size = glm::abs(axis);
  const double largest = std::max({size.x, size.y, size.z});
  if (!(largest > 0)) fail(step.at, "<rotate> needs an axis: x, y, z are all 0");
  // glm::rotate gives the axis the length 1. Divided first, since squares of tiny numbers are 0.
  return glm::rotate(glm::dmat4(1), glm::radians(number_of(step.get("angle"))), axis / largest);
}

glm::dmat4 scaling(const XmlElement& step) {
  if (step.attributes.empty()) fail(step.at, "<scale> needs the attribute value, or x, y, z");
  const XmlAttribute* value = step.find("value");
  if (value != nullptr && words(value->value, ",").size() == 2)
    fail(value->value_at, "value must be one finite number or three, got {}", found(*value));
  const bool alike = value != nullptr && !is_triple(*value) && step.attributes.size() == 1;
  const glm::dvec3 factors = alike ? glm::dvec3(number_of(*value)) : vector_of(step, 1);
  for (const XmlAttribute& a : step.attributes) {
    const glm::dvec3 here = is_triple(a) ? triple_of(a) : glm::dvec3(number_of(a));
    if (here.x == 0 || here.y == 0 || here.z == 0) {
      fail(a.value_at, "a scale of 0 leaves nothing of the object");
    }
  }
  return glm::scale(glm::dmat4(1), factors);
}

// Local +z goes from origin to target, local +y lies with it and `up` in one plane, local +x points
// to the left of someone who looks that way.
glm::dmat4 look_at(const XmlElement& step) {
  const glm::dvec3 origin = triple_of(step.get("origin"));
  const glm::dvec3 forward = triple_of(step.get("target")) - origin;
  const glm::dvec3 up =
      step.find("up") != nullptr ? triple_of(*step.find("up")) : glm::dvec3(0, 1, 0);
  if (!(glm::length(forward) > 0))
    fail(step.at, "<{}>: origin and target are the same point", step.name);
  if (!(glm::length(up) > 0)) fail(step.at, "<{}>: up is 0", step.name);
  const glm::dvec3 z = glm::normalize(forward);
  const glm::dvec3 left = glm::cross(glm::normalize(up), z);
  if (!(glm::length(left) > 1e-7)) {
    fail(step.at, "<{}>: up is parallel to the direction of view", step.name);
  }
  const glm::dvec3 x = glm::normalize(left);
  const glm::dvec3 y = glm::cross(z, x);
  return {glm::dvec4(x, 0), glm::dvec4(y, 0), glm::dvec4(z, 0), glm::dvec4(origin, 1)};
}

glm::dmat4 matrix(const XmlElement& step) {
  const XmlAttribute& value = step.get("value");
  const auto parts = words(value.value, ",");
  if (parts.size() != 16 && parts.size() != 9) {
    fail(value.value_at, "a matrix has 16 numbers (4 rows of 4) or 9 (3 of 3), got {}",
         parts.size());
  }
  const std::size_t side = parts.size() == 16 ? 4 : 3;
  glm::dmat4 out(1);
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const auto row = static_cast<int>(i / side), column = static_cast<int>(i % side);
    const auto number = parse_number(parts[i]);
    if (!number) {
      fail(value.value_at, "a matrix has {}, got {} in row {}, column {}", numbers_wanted(parts[i]),
           in_quotes(parts[i]), row + 1, column + 1);
    }
    out[column][row] = *number;
  }
  if (out[0][3] != 0 || out[1][3] != 0 || out[2][3] != 0 || out[3][3] != 1) {
    fail(value.value_at, "the last row of a matrix must be 0 0 0 1 (no projective transforms)");
  }
  return out;
}

struct Step {
  std::string_view name;
  glm::dmat4 (*matrix)(const XmlElement&);
  std::vector<std::string_view> attributes;
};

const std::vector<Step>& steps() {
  static const std::vector<Step> all = {
      {"translate", translation, {"value", "x", "y", "z"}},
      {"rotate", rotation, {"value", "x", "y", "z", "angle"}},
      {"scale", scaling, {"value", "x", "y", "z"}},
      {"lookat", look_at, {"origin", "target", "up"}},
      {"lookAt", look_at, {"origin", "target", "up"}},
      {"look_at", look_at, {"origin", "target", "up"}},
      {"matrix", matrix, {"value"}},
  };
  return all;
}

const Step& step_of(const XmlElement& element) {
  for (const Step& step : steps()) {
    if (step.name == element.name) return step;
  }
  fail(element.at, "<{}> is not a step of a <transform>{}", element.name,
       suggest(element.name, {"translate", "rotate", "scale", "lookat", "matrix"}));
}

// Compares the determinant with the lengths of the columns, so that a small object does not pass
// for a flat one.
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

/// Reports errors in a step's attributes, each by itself; throws Error at the step if they make no
/// sense together.
void check_step(const XmlElement& element, SceneErrors& errors) {
  const Step& step = step_of(element);
  bool good = element.allow_only(step.attributes, errors);
  good = element.allow_nothing_inside(errors) && good && !element.broken;
  for (const XmlAttribute& a : element.attributes) {
    if (a.broken) continue;
    if (a.name.size() == 1 || a.name == "angle")
      good = errors.guard([&] { number_of(a); }) && good;
    else if (a.name == "origin" || a.name == "target" || a.name == "up")
      good = errors.guard([&] { triple_of(a); }) && good;
  }
  if (good) check_invertible(step.matrix(element), element.at);
}

Vec3 narrowed(glm::dvec3 v, Position at) {
  const Vec3 out(v);
  if (!(std::isfinite(out.x) && std::isfinite(out.y) && std::isfinite(out.z))) {
    fail(at, "a coordinate is not finite after toWorld: ({}, {}, {})", v.x, v.y, v.z);
  }
  return out;
}

}  // namespace

bool check_steps(const XmlElement& transform, SceneErrors& errors) {
  const std::size_t before = errors.count();
  transform.allow_only({"name"}, errors);
  bool whole = true;  // apart from $parameters, which are reported elsewhere
  for (const XmlElement& step : transform.children) {
    whole = whole && !step.broken;
    errors.guard([&] { check_step(step, errors); });
  }
  return whole && errors.count() == before;
}

glm::dmat4 parse_transform(const XmlElement& element) {
  glm::dmat4 all(1);
  for (const XmlElement& step : element.children)
    all = step_of(step).matrix(step) * all;
  check_invertible(all, element.at);
  return all;
}

std::vector<std::string> notes_on_steps(const XmlElement& transform) {
  std::vector<std::string> notes;
  const bool mitsuba3 = transform.at.source->dialect == Dialect::mitsuba3;
  for (const XmlElement& step : transform.children) {
    const bool turns = step.name == "rotate", looks = step.find("target") != nullptr;
    const double length = turns ? glm::length(vector_of(step, 0)) : 1;
    if (mitsuba3 && std::abs(length - 1) > 1e-3) {
      notes.push_back(fmt::format(
          "<rotate> about an axis of length {:.3g} only turns, as in Mitsuba 0.6; Mitsuba 3 scales "
          "as well",
          length));
    }
    if (looks && step.find("up") == nullptr) {
      notes.push_back(fmt::format(
          "<{}> without up: (0, 1, 0) is up; Mitsuba takes any direction across the view",
          step.name));
    }
  }
  return notes;
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

std::optional<Similarity> similarity(const glm::dmat4& transform) {
  const glm::dmat3 linear(transform);
  for (int i = 0; i < 3; ++i) {
    if (!equal_and_orthogonal(linear[i], linear[(i + 1) % 3])) return {};
  }
  const glm::dvec3 x = glm::normalize(linear[0]);
  const glm::dvec3 y = glm::normalize(linear[1] - glm::dot(linear[1], x) * x);
  const glm::dvec3 z = (mirrors(transform) ? -1.0 : 1.0) * glm::cross(x, y);
  const double scale = std::cbrt(std::abs(glm::determinant(linear)));
  return Similarity{glm::dmat3(x, y, z), glm::dvec3(transform[3]), scale};
}

}  // namespace carlo
