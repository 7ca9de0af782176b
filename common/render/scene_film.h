#pragma once

#include "scene/scene.h"

namespace carlo {

/// A radiance of the order of the brightest light of the scene (film.h).
double radiance_scale(const Scene& scene);

/// Changes the film's size as if the scene file had it: the field of view keeps its axis.
void resize(Scene& scene, int width, int height);

}  // namespace carlo
