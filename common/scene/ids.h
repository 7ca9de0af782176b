#pragma once

#include "scene/xml_source.h"

#include <map>
#include <string>

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

}  // namespace carlo
