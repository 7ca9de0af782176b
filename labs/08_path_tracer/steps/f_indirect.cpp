#include "course/not_implemented.h"
#include "path_tracer.h"

// Lab 08, step f: direct light from the lights, indirect light by recursion. path_tracer.h says
// what each function takes and returns.

namespace lab08 {

// Lab 8.6 -----------------------------------------------------------------------------------------

Rgb trace_direct(const World& world, const Ray& ray, bool with_emission, Rng& rng) {
  // 1. The nearest surface; without one, the environment.
  // 2. What the surface emits, if it is to be counted.
  // 3. Light straight from the lights: direct_by_area() with this surface's BRDF.
  // 4. Light from elsewhere: sample(), and recursion. What must the next surface not count?
  carlo::not_implemented("Lab 8.6", "Monte Carlo Path Tracer");
}

}  // namespace lab08
