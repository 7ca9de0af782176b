#include "render/scene_film.h"

#include "support/error.h"

namespace carlo {
void resize(Scene& scene, int width, int height) {
  if (width < 1 || height < 1) {
    throw Error("the film must be at least 1x1, got {}x{}", width, height);
  }
  scene.width = width;
  scene.height = height;
  scene.camera.fit_film(width, height);
}

}  // namespace carlo
