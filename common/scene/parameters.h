#pragma once

#include "scene/xml_source.h"

#include <map>
#include <set>
#include <string>
#include <vector>

namespace carlo {

/// The $parameters of a scene: <default name="spp" value="16"/> declares one, and `$spp` in any
/// attribute's value stands for it. The caller's overrides take precedence over defaults; among
/// several files (the scene and its includes) the first default wins.
class Parameters {
 public:
  explicit Parameters(std::map<std::string, std::string> overrides)
      : overrides_(std::move(overrides)) {}

  /// Declares a <default>. Throws Error if the file has declared that name before.
  void declare(const XmlElement& element, SceneErrors& errors);

  /// Replaces $names in the attributes of `element` and everything below it. An unknown name is
  /// reported, unless it may be in a file that could not be read, and breaks its element.
  void substitute(XmlElement& element, SceneErrors& errors) const;

  /// Reports each override that names no <default>, at `at`.
  void check_overrides(Position at, SceneErrors& errors) const;

 private:
  /// Throws Error at an unknown name.
  std::string replaced(const XmlAttribute& attribute) const;
  std::vector<std::string> names() const;

  std::map<std::string, std::string> overrides_;
  std::map<std::string, std::string> values_;
  std::set<std::pair<const XmlSource*, std::string>> declared_;
};

}  // namespace carlo
