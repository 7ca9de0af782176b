#include "bias.h"
#include "course/not_implemented.h"

// Lab 09, step b: pixel filters. bias.h says what each function takes and returns.

namespace lab09 {

// Lab 9.2 -----------------------------------------------------------------------------------------

double filter_value(const PixelFilter& filter, double x, double y) {
  // 1. One curve along an axis: 0 beyond the radius, and its integral over what is left is 1. For
  //    the Gaussian that takes std::erf().
  // 2. Its value at x times its value at y.
  carlo::not_implemented("Lab 9.2", "Rendering = integration: Antialiasing");
}

Offset sample_filter(const PixelFilter& filter, Vec2 u) {
  // 1. x is made of u.x, and y of u.y, in the same way. In double: next to 1 floats have too
  //    few digits for the Gaussian's tail.
  // 2. The share |2u - 1| lies within which distance of the middle? 2u - 1 gives the sign.
  // 3. Box and tent have a formula. For the Gaussian find the place where the share is right.
  carlo::not_implemented("Lab 9.2", "Rendering = integration: Antialiasing");
}

Rgb filtered_pixel(const carlo::Camera& camera, int width, int height, int x, int y,
                   const PixelFilter& filter, int samples, const Radiance& radiance, Rng& rng) {
  // 1. Two rng.uniform_float() make an offset, in two statements.
  // 2. The film's point: from the pixel's middle, in parts of width and height (Lab 8.1).
  // 3. What weight do the radiances have, if the offsets are drawn from the filter?
  carlo::not_implemented("Lab 9.2", "Rendering = integration: Antialiasing");
}

Rgb weighted_pixel(const carlo::Camera& camera, int width, int height, int x, int y,
                   const PixelFilter& filter, int samples, const Radiance& radiance, Rng& rng) {
  // 1. An offset that is uniform in the square from -radius to radius.
  // 2. Sums of weights and of weighted radiances. Can the first be 0?
  carlo::not_implemented("Lab 9.2", "Rendering = integration: Antialiasing");
}

}  // namespace lab09
