#pragma once

#include "scene/scene.h"
#include "support/error.h"

namespace carlo {

/// Sets the film's size as if the scene file had it: the field of view stays along the same axis.
inline void resize(Scene& scene, int width, int height) {
  if (width < 1 || height < 1)
    throw Error("the film must be at least 1x1, got {}x{}", width, height);
  scene.width = width;
  scene.height = height;
  scene.camera.fit_film(width, height);
}

}  // namespace carlo
