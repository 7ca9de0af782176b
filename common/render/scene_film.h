#pragma once

#include "scene/scene.h"

namespace carlo {

/// Sets the film's size as if the scene file had it: the field of view stays along the same axis.
void resize(Scene& scene, int width, int height);

}  // namespace carlo
