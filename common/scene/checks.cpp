#include "scene/checks.h"

#include "scene/text.h"
#include "scene/transforms.h"
#include "scene/values.h"

#include <cmath>
#include <limits>

namespace carlo {
namespace {

bool check_point(const XmlElement& property, SceneErrors& errors) {
  const bool whole = property.find("value") != nullptr;
  bool good = whole ? property.allow_only({"name", "value"}, errors)
                    : property.allow_only({"name", "x", "y", "z"}, errors);
  for (const char* axis : {"x", "y", "z"}) {
    if (whole) break;
    good = errors.guard([&] {
      const XmlAttribute& number = property.get(axis);
      if (!number.broken) number_of(number);
    }) && good;
  }
  return good;
}

}  // namespace

void anything(const XmlElement& /*property*/) {}

void above_zero(const XmlElement& property) {
  const float value = number_value(property);
  if (value > 0) return;
  const XmlAttribute& written = property.get("value");
  if (number_of(written) > 0)
    wrong(property, "must be a number > 0 that a float can hold, got {}", found(written));
  wrong(property, "must be > 0, got {}", value);
}

void zero_or_above(const XmlElement& property) {
  const float value = number_value(property);
  if (!(value >= 0)) wrong(property, "must be >= 0, got {}", value);
}

void an_angle(const XmlElement& property) {
  const float value = number_value(property);
  // Only the tangent of half the angle matters, as a float.
  const auto tangent = static_cast<float>(std::tan(glm::radians(static_cast<double>(value)) / 2));
  if (!(value > 0 && value < 180 && tangent > 0)) {
    wrong(property, "must be within (0, 180) degrees, got {}", value);
  }
}

void a_count(const XmlElement& property) {
  const int value = integer_value(property);
  if (value < 1) wrong(property, "must be >= 1, got {}", value);
}

void a_depth(const XmlElement& property) {
  const int value = integer_value(property);
  if (value < -1 || value == 0) wrong(property, "must be >= 1, or -1 for no limit, got {}", value);
}

void an_ior(const XmlElement& property) {
  const float value = ior_value(property);
  if (!(value > 0)) wrong(property, "must be > 0, got {}", value);
}

void a_reflectance(const XmlElement& property) {
  const Rgb value = colour_value(property);
  for (int i = 0; i < 3; ++i) {
    if (!(value[i] >= 0 && value[i] <= 1))
      wrong(property, "must be within [0, 1], got {}", found(property.get("value")));
  }
}

void an_emission(const XmlElement& property) {
  const Rgb value = emission_value(property);
  for (int i = 0; i < 3; ++i) {
    if (!(value[i] >= 0)) wrong(property, "must be >= 0, got {}", found(property.get("value")));
    if (!(value[i] <= std::numeric_limits<float>::max()))
      wrong(property, "is out of float's range: {}", found(property.get("value")));
  }
}

void a_transform(const XmlElement& property) {
  parse_transform(property);
}

void only_true(const XmlElement& property) {
  if (!boolean_value(property)) wrong(property, "must be true: false is not supported");
}

void only_false(const XmlElement& property) {
  if (boolean_value(property)) wrong(property, "must be false: true is not supported");
}

void only_zero(const XmlElement& property) {
  const float value = number_value(property);
  if (value != 0) wrong(property, "must be 0, got {}: no other is supported", value);
}

void no_pixels(const XmlElement& property) {
  const int value = integer_value(property);
  if (value != 0) wrong(property, "must be 0, got {}: images are rendered whole", value);
}

void only_half(const XmlElement& property) {
  const float value = number_value(property);
  if (value != 0.5f) wrong(property, "must be 0.5, got {}: no other is supported", value);
}

void only_one(const XmlElement& property) {
  if (colour_value(property) != Rgb(1))
    wrong(property, "must be 1, got {}: no other is supported", found(property.get("value")));
}

void only_none(const XmlElement& property) {
  const std::string& value = text_value(property);
  if (value == "none") return;
  fail(property.get("value").value_at,
       "only <string name=\"material\" value=\"none\"/>, a perfect mirror, is supported, got {}",
       in_quotes(value));
}

bool check_parts(const XmlElement& property, SceneErrors& errors) {
  if (property.name == "transform") return check_steps(property, errors);
  const bool good = property.name == "point" || property.name == "vector"
                        ? check_point(property, errors)
                        : property.allow_only({"name", "value"}, errors);
  return property.allow_nothing_inside(errors) && good;
}

}  // namespace carlo
