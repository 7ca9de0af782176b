#include "scene/root.h"

#include "scene/names.h"
#include "scene/text.h"

#include <algorithm>
#include <array>

namespace carlo {
namespace {

/// An element that identifies a Nori scene: cameras and meshes have names of their own there, and
/// the root has no version.
const XmlElement* nori_element(const XmlElement& root) {
  constexpr std::array names = {"camera", "mesh", "test"};
  const auto is_nori = [&](const XmlElement& child) {
    return std::find(names.begin(), names.end(), child.name) != names.end();
  };
  if (root.name == "test") return &root;
  const auto found = std::find_if(root.children.begin(), root.children.end(), is_nori);
  return root.find("version") != nullptr || found == root.children.end() ? nullptr : &*found;
}

}  // namespace

void check_root(const XmlElement& root, SceneErrors& errors) {
  if (const XmlElement* nori = nori_element(root)) {
    fail(
        nori->at,
        "<{}> is of Nori's scene format, which is not read: Mitsuba's has <scene version=\"0.6.0\">, "
        "<sensor> for <camera>, <shape> for <mesh>, <rgb> for <color>",
        nori->name);
  }
  if (root.name != "scene") {
    fail(root.at, "the root element is <{}>, expected <scene>", root.name);
  }
  root.allow_only({"version"}, errors);
}

Dialect dialect(const XmlElement& root) {
  const XmlAttribute& version = root.get("version");
  const auto known = dialect_of(version.value);
  if (!known) {
    fail(version.value_at, "scene version {} is not supported, expected 0.5.x, 0.6.x, 2.x or 3.x",
         in_quotes(version.value));
  }
  return *known;
}

}  // namespace carlo
