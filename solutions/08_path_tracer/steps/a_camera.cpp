#include "path_tracer.h"

// Lab 08, step a: camera rays, one in each stratum of a pixel. Solved.

namespace lab08 {

// Lab 8.1 -----------------------------------------------------------------------------------------

Rgb pixel_radiance(const carlo::Camera& camera, int width, int height, int x, int y, int strata,
                   const Radiance& radiance, Rng& rng) {
  glm::dvec3 sum(0);
  const auto place = [strata](int pixel, int stratum, float u) {
    return pixel + (stratum + static_cast<double>(u)) / strata;
  };
  for (int row = 0; row < strata; ++row) {
    for (int column = 0; column < strata; ++column) {
      const float across = rng.uniform_float();
      const float down = rng.uniform_float();
      const Vec2 film(place(x, column, across) / width, place(y, row, down) / height);
      sum += radiance(camera.ray(film));
    }
  }
  return sum / static_cast<double>(strata * strata);
}

}  // namespace lab08
