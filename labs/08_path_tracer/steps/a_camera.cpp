#include "course/not_implemented.h"
#include "path_tracer.h"

// Lab 08, step a: camera rays, one in each stratum of a pixel. path_tracer.h says what each
// function takes and returns.

namespace lab08 {

// Lab 8.1 -----------------------------------------------------------------------------------------

Rgb pixel_radiance(const carlo::Camera& camera, int width, int height, int x, int y, int strata,
                   const Radiance& radiance, Rng& rng) {
  // 1. Go through the strata. Where in the pixel does each begin, and how large is it?
  // 2. Draw a point of it: two numbers, a statement each. Neither may be left at the middle.
  // 3. From the pixel's own corner to the film: Camera::ray() takes 0 to 1 over the whole film.
  // 4. Ask for the radiance along each ray once. Sum in double; return the mean.
  carlo::not_implemented("Lab 8.1", "Monte Carlo Path Tracer");
}

}  // namespace lab08
