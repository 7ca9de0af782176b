#include "course/not_implemented.h"
#include "hemisphere.h"
#include "path_tracer.h"

#include <algorithm>
#include <cmath>

// Lab 08, step d: the lecture's TracePath, and its cure. path_tracer.h says what each function
// takes and returns.

namespace lab08 {

// Lab 8.4 -----------------------------------------------------------------------------------------

float p_emit(const Surface& surface) {
  carlo::not_implemented("Lab 8.4", "Monte Carlo Path Tracer");
}

Rgb trace_path_lecture(const World& world, const Ray& ray, Rng& rng) {
  carlo::not_implemented("Lab 8.4", "Monte Carlo Path Tracer");
}

Rgb trace_path(const World& world, const Ray& ray, Rng& rng) {
  carlo::not_implemented("Lab 8.4", "Monte Carlo Path Tracer");
}

}  // namespace lab08
