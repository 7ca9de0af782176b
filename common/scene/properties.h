#pragma once

#include "numeric/vec.h"
#include "scene/xml_source.h"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace carlo {

/// The properties and nested objects of one plugin (<bsdf type="phong"> ... </bsdf>) that was
/// checked (grammar.h). Names are Mitsuba 0.6's. Asking for a property that plugins.h does not list
/// is a std::logic_error.
class Properties {
 public:
  /// `object` must outlive this. `center`: the point of the file's world that is the scene's
  /// origin.
  explicit Properties(const XmlElement& object, glm::dvec3 center = glm::dvec3(0));

  /// The plugin's name, its attribute `type`; if another plugin replaces it, that one's name.
  std::string type() const;
  Position type_at() const { return object_.get("type").value_at; }
  Position object_at() const { return object_.at; }
  Dialect dialect() const { return object_.at.source->dialect; }

  bool has(std::string_view name) const { return find(name) != nullptr; }
  /// The position of a property's value; the object itself if the property is not given.
  Position at(std::string_view name) const;

  /// A property of each kind; empty if it is not given.
  std::optional<float> number(const std::string& name);
  std::optional<int> integer(const std::string& name);
  std::optional<bool> boolean(const std::string& name);
  std::optional<std::string> string(const std::string& name);
  std::optional<glm::dvec3> point(const std::string& name);
  std::optional<glm::dmat4> transform(const std::string& name);
  /// The transform `toWorld`, relative to the scene's origin; the identity if it is not given.
  glm::dmat4 to_world();
  std::optional<Rgb> reflectance(const std::string& name);
  std::optional<Rgb> emission(const std::string& name);
  /// A number, or the index of the named medium.
  std::optional<float> ior(const std::string& name);
  /// The element of a property that is not a number, text or transform; null if it is not given.
  const XmlElement* take(const std::string& name);

  /// For a property that must be given. Throws Error at the object.
  [[noreturn]] void missing(std::string_view name, std::string_view kind) const;

  /// The nested objects with the given element name, in order.
  std::vector<const XmlElement*> objects(std::string_view element) const;
  /// The first of them; null when there is none.
  const XmlElement* object(std::string_view element) const;

  /// Throws std::logic_error if some property that plugins.h marks as read was not asked for.
  void finish() const;

 private:
  const XmlElement* find(std::string_view name) const;

  const XmlElement& object_;
  glm::dvec3 center_;
  std::vector<std::string> asked_;
};

}  // namespace carlo
