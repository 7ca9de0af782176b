#pragma once

#include "scene/xml_source.h"

#include <map>
#include <string>

namespace carlo {

/// The ids of a scene and its includes: each names one object.
class Ids {
 public:
  /// Takes in the ids of `element` and of all below it, and tells of each that is taken.
  void declare(const XmlElement& element, SceneErrors& errors);

  /// The element name ("bsdf") of the object with that id; null when there is none.
  const std::string* kind(const std::string& id) const;

 private:
  std::map<std::string, std::string> kinds_;
};

}  // namespace carlo
