#pragma once

#include "scene/envmap.h"
#include "scene/properties.h"

#include <string>
#include <vector>

namespace carlo {

/// The image of an <emitter type="envmap">, with its scale and its place. Throws Error at what is
/// at fault: where the file is named for what is wrong in it. What in the file is not as it stands
/// there goes to `notes`.
Envmap parse_envmap(Properties& emitter, std::vector<std::string>& notes);

}  // namespace carlo
