#include "scene/properties.h"

#include "scene/grammar.h"
#include "scene/plugins.h"
#include "scene/transforms.h"
#include "scene/values.h"

#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <stdexcept>

namespace carlo {
namespace {

template <class T>
std::optional<T> given(const XmlElement* property, T (*value)(const XmlElement&)) {
  return property == nullptr ? std::nullopt : std::optional<T>(value(*property));
}

}  // namespace

Properties::Properties(const XmlElement& object, glm::dvec3 center)
    : object_(object), center_(center) {}

std::string Properties::type() const {
  const Plugin* plugin = object_.plugin;
  return plugin != nullptr && !plugin->as.empty() ? std::string(plugin->as)
                                                  : object_.get("type").value;
}

Position Properties::at(std::string_view name) const {
  const XmlElement* element = find(name);
  if (element == nullptr) return object_.at;
  const XmlAttribute* value = element->find("value");
  return value != nullptr ? value->value_at : element->at;
}

std::optional<float> Properties::number(const std::string& name) {
  return given(take(name), number_value);
}
std::optional<int> Properties::integer(const std::string& name) {
  return given(take(name), integer_value);
}
std::optional<bool> Properties::boolean(const std::string& name) {
  return given(take(name), boolean_value);
}
std::optional<std::string> Properties::string(const std::string& name) {
  const XmlElement* element = take(name);
  if (element == nullptr) return {};
  return text_value(*element);
}
std::optional<glm::dvec3> Properties::point(const std::string& name) {
  return given(take(name), point_value);
}
std::optional<glm::dmat4> Properties::transform(const std::string& name) {
  return given(take(name), parse_transform);
}
std::optional<Rgb> Properties::reflectance(const std::string& name) {
  return given(take(name), colour_value);
}
std::optional<Rgb> Properties::emission(const std::string& name) {
  return given(take(name), emission_value);
}
std::optional<float> Properties::ior(const std::string& name) {
  return given(take(name), ior_value);
}

glm::dmat4 Properties::to_world() {
  return glm::translate(glm::dmat4(1), -center_) * transform("toWorld").value_or(glm::dmat4(1));
}

const XmlElement* Properties::take(const std::string& name) {
  if (object_.plugin == nullptr || find_rule(*object_.plugin, name) == nullptr)
    throw std::logic_error("no rule for " + object_.name + " " + type() + ", " + name);
  asked_.push_back(name);
  return find(name);
}

void Properties::missing(std::string_view name, std::string_view kind) const {
  fail_missing(object_, name, kind);
}

std::vector<const XmlElement*> Properties::objects(std::string_view element) const {
  std::vector<const XmlElement*> out;
  for (const XmlElement& child : object_.children) {
    if (child.name == element) out.push_back(&child);
  }
  return out;
}

const XmlElement* Properties::object(std::string_view element) const {
  const auto found = objects(element);
  return found.empty() ? nullptr : found[0];
}

void Properties::finish() const {
  if (object_.plugin == nullptr) return;
  for (const Rule& rule : object_.plugin->rules) {
    if (rule.treatment != Treatment::read) continue;
    if (std::find(asked_.begin(), asked_.end(), rule.name) == asked_.end()) {
      throw std::logic_error("nobody read " + object_.name + " " + type() + ", " +
                             std::string(rule.name));
    }
  }
}

const XmlElement* Properties::find(std::string_view name) const {
  const auto named = [&](const XmlElement& child) {
    // Objects may have a name too.
    const XmlAttribute* given = child.find("name");
    return given != nullptr && given->value == name && is_property(child);
  };
  const auto found = std::find_if(object_.children.begin(), object_.children.end(), named);
  return found == object_.children.end() ? nullptr : &*found;
}

}  // namespace carlo
