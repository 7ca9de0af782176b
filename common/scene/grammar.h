#pragma once

#include "scene/xml_source.h"

#include <string>
#include <string_view>
#include <vector>

namespace carlo {

/// Reports all errors of an object (<bsdf>, <shape>, ...) and its contents, each element and
/// property by itself, according to plugins.h. Errors of their combination are left to the builders
/// of the scene. An object with an error of its own is broken: it must not be built. Afterwards
/// properties have Mitsuba 0.6's names. `within`: the enclosing element. What is accepted without
/// effect but deserves mention goes to `notes`.
void check_object(XmlElement& object, std::string_view within, SceneErrors& errors,
                  std::vector<std::string>& notes);

/// True if an element is a property (<float>), not an object (<bsdf>).
bool is_property(const XmlElement& element);

/// Throws Error at an object that lacks a property.
[[noreturn]] void fail_missing(const XmlElement& object, std::string_view property,
                               std::string_view kind);

}  // namespace carlo
