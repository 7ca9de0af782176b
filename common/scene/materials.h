#pragma once

#include "scene/ids.h"
#include "scene/properties.h"
#include "scene/scene.h"

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace carlo {

/// The largest exponent of a Phong lobe. Larger ones are taken as this one, with a note: its lobe
/// is 5e-7 wide, where directions are floats, and above 1e15 their rounding would leave the lobe.
inline constexpr float sharpest_exponent = 1e13f;

/// Reads <bsdf> elements and keeps those that shapes use.
class Materials {
 public:
  Materials(const Ids& ids, SceneErrors& errors) : ids_(ids), errors_(errors) {}

  /// A <bsdf> that stands in the scene for <ref>s to name.
  void define(const XmlElement& bsdf);

  /// The index into list() of the material of a shape: of its <bsdf> or <ref>, else Mitsuba's
  /// default, grey 0.5, or black for a light.
  std::uint32_t of_shape(const Properties& shape, bool emits);

  const std::vector<Material>& list() const { return list_; }

  /// What is worth a note, as that no shape uses a material.
  std::vector<std::string> notes() const;

 private:
  struct Entry {
    Material material;
    std::int64_t index = -1;  ///< into list_; -1 while no shape uses it
    bool used = false;
  };

  /// What is wrong is told of. Then the result stands in for the material, so that nobody misses
  /// it.
  Material parse(const XmlElement& bsdf);
  Material built(const XmlElement& bsdf);
  Material parse_two_sided(const Properties& bsdf);
  Phong parse_phong(Properties& bsdf);
  Entry& resolve(const XmlElement& ref);
  std::uint32_t add(const Material& material);

  const Ids& ids_;
  SceneErrors& errors_;
  Entry unknown_;
  std::vector<std::string> open_;  // ids of those being read, outermost first
  std::map<std::string, Entry> named_;
  std::vector<Material> list_;
  std::vector<std::string> notes_;
};

}  // namespace carlo
