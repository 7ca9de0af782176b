#pragma once

#include "scene/envmap.h"
#include "scene/properties.h"

namespace carlo {

/// The image of an <emitter type="envmap">, with its scale and its place. Throws Error at what is
/// at fault: where the file is named for what is wrong in it.
Envmap parse_envmap(Properties& emitter);

}  // namespace carlo
