#include "course/not_implemented.h"
#include "path_tracer.h"

#include <algorithm>
#include <cmath>

// Lab 08, step h: the path tracer, in a loop, with all the techniques that reduce its error.
// path_tracer.h says what each function takes and returns.

namespace lab08 {

// Lab 8.8 -----------------------------------------------------------------------------------------

float power_heuristic(float p, float q) {
  // 1. p^2/(p^2 + q^2) by one ratio that may be infinite, but neither 0/0 nor infinite/infinite.
  carlo::not_implemented("Lab 8.8", "Monte Carlo Path Tracer");
}

float light_pdf(const World& world, const Surface& from, const Surface& to) {
  // 1. Not a light, or its dark side: 0.
  // 2. Density per area, times the chance of this light; then from area to solid angle.
  carlo::not_implemented("Lab 8.8", "Monte Carlo Path Tracer");
}

Rgb path_radiance(const World& world, const Ray& ray, int max_depth, Dimensions& dimensions) {
  // 1. Keep the ray, the throughput so far and the sum so far; and of the last vertex what the
  //    weight of the next emission needs: its position and the density of its direction.
  // 2. Each turn: the nearest surface or the environment; emission with its weight; the depth.
  // 3. At a Phong surface: a point of a light with its weight, then sample()'s direction. Mirrors
  //    and glass: one direction, after which emission counts in full.
  // 4. Throughput, next ray, roulette: who survives carries more.
  // 5. Before each read, seek() to this vertex's dimension for this decision. A vertex that does
  //    not need a number skips its dimension.
  carlo::not_implemented("Lab 8.8", "Monte Carlo Path Tracer");
}

}  // namespace lab08
