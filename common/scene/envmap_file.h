#pragma once

#include "scene/envmap.h"
#include "scene/properties.h"

#include <string>
#include <vector>

namespace carlo {

/// Reads the image of an <emitter type="envmap"> with its scale and transform. Throws Error at what
/// is wrong; for errors in the file, where it is named. Deviations from the file's contents go to
/// `notes`.
Envmap parse_envmap(Properties& emitter, std::vector<std::string>& notes);

}  // namespace carlo
