#pragma once

#include "scene/scene.h"

namespace carlo {

/// Changes the film's size as if the scene file had it: the field of view keeps its axis.
void resize(Scene& scene, int width, int height);

}  // namespace carlo
