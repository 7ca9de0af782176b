#include "course/not_implemented.h"
#include "path_tracer.h"

// Lab 08, step d: the lecture's TracePath, and its cure. path_tracer.h says what each function
// takes and returns.

namespace lab08 {

// Lab 8.4 -----------------------------------------------------------------------------------------

float p_emit(const Surface& surface) {
  // 1. Three cases. f_r is 0 where both reflectances are, in every channel.
  carlo::not_implemented("Lab 8.4", "Monte Carlo Path Tracer");
}

Rgb trace_path_lecture(const World& world, const Ray& ray, Rng& rng) {
  // 1. The nearest surface; without one, the environment.
  // 2. One random number decides between emission and reflection.
  // 3. Emission: divide by the probability of this choice.
  // 4. Reflection: three numbers for sample(), a statement each. Nothing drawn: nothing arrives.
  // 5. Recursion along the ray that leaves the surface; weight it, and divide by the probability of
  //    this choice.
  carlo::not_implemented("Lab 8.4", "Monte Carlo Path Tracer");
}

Rgb trace_path(const World& world, const Ray& ray, Rng& rng) {
  // 1. As above, but emission needs no choice: a term that is always added is divided by nothing.
  carlo::not_implemented("Lab 8.4", "Monte Carlo Path Tracer");
}

}  // namespace lab08
