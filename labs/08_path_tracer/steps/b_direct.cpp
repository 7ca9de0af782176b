#include "course/not_implemented.h"
#include "hemisphere.h"
#include "path_tracer.h"

#include <algorithm>
#include <cmath>

// Lab 08, step b: light that comes straight from a light. path_tracer.h says what each function
// takes and returns.

namespace lab08 {

// Lab 8.2 -----------------------------------------------------------------------------------------

Rgb direct_by_area(const World& world, const Surface& surface, const Brdf& f, Rng& rng) {
  carlo::not_implemented("Lab 8.2", "Monte Carlo Path Tracer");
}

Rgb direct_by_hemisphere(const World& world, const Surface& surface, const Brdf& f, Rng& rng) {
  carlo::not_implemented("Lab 8.2", "Monte Carlo Path Tracer");
}

}  // namespace lab08
