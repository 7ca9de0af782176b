#include "course/not_implemented.h"
#include "hemisphere.h"
#include "path_tracer.h"

#include <algorithm>
#include <cmath>

// Lab 08, step h: the path tracer, in a loop, with all that makes its error small. path_tracer.h
// says what each function takes and returns.

namespace lab08 {

// Lab 8.8 -----------------------------------------------------------------------------------------

float power_heuristic(float p, float q) {
  carlo::not_implemented("Lab 8.8", "Monte Carlo Path Tracer");
}

float light_pdf(const World& world, const Surface& from, const Surface& to) {
  carlo::not_implemented("Lab 8.8", "Monte Carlo Path Tracer");
}

Rgb path_radiance(const World& world, const Ray& ray, int max_depth, Dimensions& dimensions) {
  carlo::not_implemented("Lab 8.8", "Monte Carlo Path Tracer");
}

}  // namespace lab08
