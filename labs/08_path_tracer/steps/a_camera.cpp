#include "course/not_implemented.h"
#include "hemisphere.h"
#include "path_tracer.h"

#include <algorithm>
#include <cmath>

// Lab 08, step a: camera rays, one in each stratum of a pixel. path_tracer.h says what each
// function takes and returns.

namespace lab08 {

// Lab 8.1 -----------------------------------------------------------------------------------------

Rgb pixel_radiance(const carlo::Camera& camera, int width, int height, int x, int y, int strata,
                   const Radiance& radiance, Rng& rng) {
  carlo::not_implemented("Lab 8.1", "Monte Carlo Path Tracer");
}

}  // namespace lab08
