#pragma once

#include "scene/properties.h"
#include "scene/scene.h"
#include "scene/xml_source.h"

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace carlo {

/// The ids of a scene and its includes: each names one object.
class Ids {
 public:
  /// Declares the ids of `element` and everything below it, and reports those already taken.
  void declare(const XmlElement& element, SceneErrors& errors);

  /// The element name ("bsdf") of the object with that id; null if there is none.
  const std::string* kind(const std::string& id) const;

 private:
  std::map<std::string, std::string> kinds_;
};

/// The largest exponent of a Phong lobe. Larger ones are replaced by this one, with a note: its
/// lobe is 5e-7 wide, as narrow as float directions allow, and above 1e15 their rounding would
/// leave the lobe.
inline constexpr float sharpest_exponent = 1e13f;

/// Reads <bsdf> elements and keeps those used by shapes.
class Materials {
 public:
  Materials(const Ids& ids, SceneErrors& errors) : ids_(ids), errors_(errors) {}

  /// Declares a <bsdf> of the scene that <ref>s may name.
  void define(const XmlElement& bsdf);

  /// The index into list() of a shape's material: from its <bsdf> or <ref>, otherwise Mitsuba's
  /// default, grey 0.5, or black for a light.
  std::uint32_t of_shape(const Properties& shape, bool emits);

  const std::vector<Material>& list() const { return list_; }

  /// Facts that deserve a note, such as materials that no shape uses.
  std::vector<std::string> notes() const;

 private:
  struct Entry {
    Material material;
    std::int64_t index = -1;  ///< into list_; -1 while no shape uses it
    bool used = false;
  };

  /// Reports errors; the result then stands in for the material, so that it is not reported as
  /// missing.
  Material parse(const XmlElement& bsdf);
  Material built(const XmlElement& bsdf);
  Material parse_two_sided(const Properties& bsdf);
  Phong parse_phong(Properties& bsdf);
  Entry& resolve(const XmlElement& ref);
  std::uint32_t add(const Material& material);

  const Ids& ids_;
  SceneErrors& errors_;
  Entry unknown_;
  std::vector<std::string> open_;  // ids of the materials being read, outermost first
  std::map<std::string, Entry> named_;
  std::vector<Material> list_;
  std::vector<std::string> notes_;
};

}  // namespace carlo
