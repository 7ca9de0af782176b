#pragma once

#include "scene/xml_source.h"

namespace carlo {

/// Throws Error at a root element that is not a Mitsuba scene, such as one of Nori.
void check_root(const XmlElement& root, SceneErrors& errors);

/// The dialect according to the attribute `version`. Throws Error at an unsupported version, or at
/// the element.
Dialect dialect(const XmlElement& root);

}  // namespace carlo
