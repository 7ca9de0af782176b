#pragma once

#include "scene/xml_source.h"

namespace carlo {

/// Throws Error at a root element that is no scene of Mitsuba, such as one of Nori.
void check_root(const XmlElement& root, SceneErrors& errors);

/// The dialect by the attribute `version`. Throws Error at one that is not read, or at the element.
Dialect dialect(const XmlElement& root);

}  // namespace carlo
