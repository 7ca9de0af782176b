#include "course/not_implemented.h"
#include "hemisphere.h"
#include "path_tracer.h"

#include <algorithm>
#include <cmath>

// Lab 08, step f: direct light from the lights, indirect light by recursion. path_tracer.h says
// what each function takes and returns.

namespace lab08 {

// Lab 8.6 -----------------------------------------------------------------------------------------

Rgb trace_direct(const World& world, const Ray& ray, bool with_emission, Rng& rng) {
  carlo::not_implemented("Lab 8.6", "Monte Carlo Path Tracer");
}

}  // namespace lab08
