#include "bias.h"
#include "course/not_implemented.h"

// Lab 09, step b: pixel filters. bias.h says what each function takes and returns.

namespace lab09 {

// Lab 9.2 -----------------------------------------------------------------------------------------

double filter_value(const PixelFilter& filter, double x, double y) {
  carlo::not_implemented("Lab 9.2", "Rendering = integration: Antialiasing");
}

Offset sample_filter(const PixelFilter& filter, Vec2 u) {
  carlo::not_implemented("Lab 9.2", "Rendering = integration: Antialiasing");
}

Rgb filtered_pixel(const carlo::Camera& camera, int width, int height, int x, int y,
                   const PixelFilter& filter, int samples, const Radiance& radiance, Rng& rng) {
  carlo::not_implemented("Lab 9.2", "Rendering = integration: Antialiasing");
}

Rgb weighted_pixel(const carlo::Camera& camera, int width, int height, int x, int y,
                   const PixelFilter& filter, int samples, const Radiance& radiance, Rng& rng) {
  carlo::not_implemented("Lab 9.2", "Rendering = integration: Antialiasing");
}

}  // namespace lab09
