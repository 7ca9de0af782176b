#include "scene/properties.h"

#include "scene/text.h"
#include "scene/transforms.h"

#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <array>
#include <limits>

namespace carlo {
namespace {

constexpr std::array property_kinds = {"float",    "integer", "boolean", "string",   "rgb",
                                       "spectrum", "point",   "vector",  "transform"};

bool is_property(const XmlElement& element) {
  return std::find(property_kinds.begin(), property_kinds.end(), element.name) !=
         property_kinds.end();
}

// For messages: what the attribute holds, and the text it came from when $parameters were in it.
std::string found(const XmlAttribute& attribute) {
  if (attribute.value == attribute.written) return in_quotes(attribute.value);
  return fmt::format("{} (from {})", in_quotes(attribute.value), in_quotes(attribute.written));
}

const XmlAttribute& value_of(const XmlElement& element) {
  element.allow_only({"name", "value"});
  if (!element.children.empty()) {
    fail(element.children.front().at, "<{}> takes no elements inside", element.name);
  }
  return element.get("value");
}

Rgb rgb_of(const XmlElement& element, const XmlAttribute& value) {
  const auto parts = words(value.value, ",");
  if (parts.size() != 1 && parts.size() != 3) {
    fail(value.value_at, "expected \"r, g, b\" or one number, got {}", found(value));
  }
  if (element.name == "spectrum" && parts.size() != 1) {
    fail(value.value_at, "a <spectrum> is one number here (grey), got {}; use <rgb>", found(value));
  }
  Rgb out{0};
  for (std::size_t i = 0; i < 3; ++i) {
    const auto number = parse_number(parts[parts.size() == 3 ? i : 0]);
    if (!number) fail(value.value_at, "expected finite numbers, got {}", found(value));
    out[static_cast<int>(i)] = static_cast<float>(*number);
  }
  return out;
}

}  // namespace

double number_of(const XmlAttribute& attribute) {
  const auto number = parse_number(attribute.value);
  if (!number) {
    fail(attribute.value_at, "{} must be a finite number, got {}", attribute.name,
         found(attribute));
  }
  return *number;
}

Properties::Properties(const XmlElement& object, const std::vector<std::string>& objects,
                       glm::dvec3 center)
    : object_(object), center_(center) {
  object.allow_only({"type", "id"});
  object.get("type");
  for (const XmlElement& child : object.children) {
    if (is_property(child)) {
      const XmlAttribute& name = child.get("name");
      if (has(name.value)) fail(child.at, "property {} is given twice", in_quotes(name.value));
      properties_.push_back(&child);
    } else if (std::find(objects.begin(), objects.end(), child.name) != objects.end()) {
      objects_.push_back(&child);
    } else {
      fail(child.at, "<{}> cannot stand inside <{} type={}>{}", child.name, object.name,
           in_quotes(type()), suggest(child.name, {property_kinds.begin(), property_kinds.end()}));
    }
  }
}

Position Properties::at(std::string_view name) const {
  const XmlElement* element = find(name);
  if (element == nullptr) return object_.at;
  const XmlAttribute* value = element->find("value");
  return value != nullptr ? value->value_at : element->at;
}

std::optional<float> Properties::number(const std::string& name) {
  const XmlElement* element = take(name, {"float"});
  if (element == nullptr) return {};
  const XmlAttribute& value = value_of(*element);
  const auto parsed = parse_number(value.value);
  if (!parsed) fail(value.value_at, "{} must be a finite number, got {}", name, found(value));
  return static_cast<float>(*parsed);
}

std::optional<int> Properties::integer(const std::string& name) {
  const XmlElement* element = take(name, {"integer"});
  if (element == nullptr) return {};
  const XmlAttribute& value = value_of(*element);
  const auto parsed = parse_integer(value.value);
  if (!parsed) fail(value.value_at, "{} must be an integer, got {}", name, found(value));
  return parsed;
}

std::optional<bool> Properties::boolean(const std::string& name) {
  const XmlElement* element = take(name, {"boolean"});
  if (element == nullptr) return {};
  const XmlAttribute& value = value_of(*element);
  if (value.value != "true" && value.value != "false") {
    fail(value.value_at, "{} must be true or false, got {}", name, found(value));
  }
  return value.value == "true";
}

std::optional<std::string> Properties::string(const std::string& name) {
  const XmlElement* element = take(name, {"string"});
  if (element == nullptr) return {};
  return value_of(*element).value;
}

std::optional<glm::dvec3> Properties::point(const std::string& name) {
  const XmlElement* element = take(name, {"point", "vector"});
  if (element == nullptr) return {};
  element->allow_only({"name", "x", "y", "z"});
  return glm::dvec3(number_of(element->get("x")), number_of(element->get("y")),
                    number_of(element->get("z")));
}

std::optional<glm::dmat4> Properties::transform(const std::string& name) {
  const XmlElement* element = take(name, {"transform"});
  if (element == nullptr) return {};
  return parse_transform(*element);
}

glm::dmat4 Properties::to_world() {
  return glm::translate(glm::dmat4(1), -center_) * transform("toWorld").value_or(glm::dmat4(1));
}

std::optional<Rgb> Properties::colour(const std::string& name, float largest) {
  const XmlElement* element = take(name, {"rgb", "spectrum"});
  if (element == nullptr) return {};
  const XmlAttribute& value = value_of(*element);
  const Rgb rgb = rgb_of(*element, value);
  for (int i = 0; i < 3; ++i) {
    if (rgb[i] >= 0 && rgb[i] <= largest) continue;
    const bool bounded = largest < std::numeric_limits<float>::max();
    fail(value.value_at, "{} must be {}, got {}", name,
         bounded ? fmt::format("within [0, {}]", largest) : ">= 0", found(value));
  }
  return rgb;
}

bool Properties::is_string(std::string_view name) const {
  const XmlElement* element = find(name);
  return element != nullptr && element->name == "string";
}

void Properties::missing(std::string_view name, std::string_view kind) const {
  for (const XmlElement* property : properties_) {
    const std::string& given = property->get("name").value;
    const bool asked = std::find(asked_.begin(), asked_.end(), given) != asked_.end();
    if (asked || !is_near(given, name)) continue;
    fail(property->at, "<{} type={}> has no property {} (did you mean {}?)", object_.name,
         in_quotes(type()), in_quotes(given), in_quotes(name));
  }
  fail(object_.at, "<{} type={}> needs <{} name={} .../>", object_.name, in_quotes(type()), kind,
       in_quotes(name));
}

std::vector<const XmlElement*> Properties::objects(std::string_view element) const {
  std::vector<const XmlElement*> out;
  for (const XmlElement* o : objects_) {
    if (o->name == element) out.push_back(o);
  }
  return out;
}

const XmlElement* Properties::object(std::string_view element) const {
  const auto found = objects(element);
  if (found.size() > 1) {
    fail(found[1]->at, "a second <{}> inside <{} type={}>, expected one", element, object_.name,
         in_quotes(type()));
  }
  return found.empty() ? nullptr : found[0];
}

void Properties::finish() const {
  for (const XmlElement* property : properties_) {
    const std::string& name = property->get("name").value;
    if (std::find(asked_.begin(), asked_.end(), name) != asked_.end()) continue;
    fail(property->at, "<{} type={}> has no property {}{}", object_.name, in_quotes(type()),
         in_quotes(name), suggest(name, asked_));
  }
}

const XmlElement* Properties::find(std::string_view name) const {
  const auto named = [&](const XmlElement* p) { return p->get("name").value == name; };
  const auto found = std::find_if(properties_.begin(), properties_.end(), named);
  return found == properties_.end() ? nullptr : *found;
}

const XmlElement* Properties::take(const std::string& name,
                                   const std::vector<std::string_view>& kinds) {
  asked_.push_back(name);
  const XmlElement* element = find(name);
  if (element == nullptr) return nullptr;
  if (std::find(kinds.begin(), kinds.end(), element->name) == kinds.end()) {
    fail(element->at, "{} must be given as <{}>, got <{}>", name, fmt::join(kinds, "> or <"),
         element->name);
  }
  return element;
}

}  // namespace carlo
