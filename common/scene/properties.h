#pragma once

#include "numeric/vec.h"
#include "scene/xml_source.h"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace carlo {

/// The number in an attribute. Throws Error at the value when it is anything else.
double number_of(const XmlAttribute& attribute);

/// The properties and nested objects of one plugin (<bsdf type="phong"> ... </bsdf>). Each query
/// names a property once; finish() then complains of those that nobody asked for. A property that
/// is given twice, or with the wrong kind of element, is an Error.
class Properties {
 public:
  /// `objects`: the elements besides properties that may stand inside, such as "bsdf". `object`
  /// must outlive this. `center`: the point of the file's world that is the scene's origin.
  Properties(const XmlElement& object, const std::vector<std::string>& objects = {},
             glm::dvec3 center = glm::dvec3(0));

  /// The plugin's name, its attribute `type`.
  const std::string& type() const { return object_.get("type").value; }
  Position type_at() const { return object_.get("type").value_at; }
  Position object_at() const { return object_.at; }

  bool has(std::string_view name) const { return find(name) != nullptr; }
  /// Where the value of a property stands; the object itself for one that is not given.
  Position at(std::string_view name) const;

  /// A property of each kind; empty when it is not given.
  std::optional<float> number(const std::string& name);
  std::optional<int> integer(const std::string& name);
  std::optional<bool> boolean(const std::string& name);
  std::optional<std::string> string(const std::string& name);
  std::optional<glm::dvec3> point(const std::string& name);
  std::optional<glm::dmat4> transform(const std::string& name);
  /// The transform `toWorld`, the identity when it is not given, to the scene's origin.
  glm::dmat4 to_world();
  /// <rgb value="r, g, b"/> or, for a grey, <spectrum value="x"/>; each channel in [0, `largest`].
  std::optional<Rgb> colour(const std::string& name, float largest);
  /// <float> or <string>: a number or a name to look up.
  bool is_string(std::string_view name) const;

  /// For a property that must be given. Throws Error at the object, or at a property that looks as
  /// if this one had been meant.
  [[noreturn]] void missing(std::string_view name, std::string_view kind) const;

  /// The nested objects with the given element name, in order.
  std::vector<const XmlElement*> objects(std::string_view element) const;
  /// The only nested object with that name; null when there is none, Error at the second.
  const XmlElement* object(std::string_view element) const;

  /// Throws Error at the first property that was not asked for.
  void finish() const;

 private:
  const XmlElement* find(std::string_view name) const;
  /// The element of a property, which must be one of `kinds`; null when it is not given.
  const XmlElement* take(const std::string& name, const std::vector<std::string_view>& kinds);

  const XmlElement& object_;
  glm::dvec3 center_;
  std::vector<const XmlElement*> properties_;
  std::vector<const XmlElement*> objects_;
  std::vector<std::string> asked_;
};

}  // namespace carlo
