#pragma once

#include "scene/xml_source.h"

#include <string>
#include <string_view>
#include <vector>

namespace carlo {

/// Tells all that is wrong with an object (<bsdf>, <shape>, ...) and what stands inside, each
/// element and property by itself, as plugins.h knows them. What is wrong with them together is
/// left to those who build the scene. An object that has an error of its own is broken: nobody must
/// build it. Properties have Mitsuba 0.6's names afterwards. `within`: the element around it. What
/// is taken without effect but worth a word goes to `notes`.
void check_object(XmlElement& object, std::string_view within, SceneErrors& errors,
                  std::vector<std::string>& notes);

/// Whether an element is a property (<float>), not an object (<bsdf>).
bool is_property(const XmlElement& element);

/// Throws Error at an object that lacks a property.
[[noreturn]] void fail_missing(const XmlElement& object, std::string_view property,
                               std::string_view kind);

}  // namespace carlo
