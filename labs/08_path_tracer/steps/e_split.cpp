#include "course/not_implemented.h"
#include "hemisphere.h"
#include "path_tracer.h"

#include <algorithm>
#include <cmath>

// Lab 08, step e: one ray to the light and one elsewhere. path_tracer.h says what each function
// takes and returns.

namespace lab08 {

// Lab 8.5 -----------------------------------------------------------------------------------------

Rgb reflect_split(const Cone& light, Vec3 normal, const Brdf& f, const Incoming& incoming,
                  Rng& rng) {
  carlo::not_implemented("Lab 8.5", "Monte Carlo Path Tracer");
}

Rgb reflect_split_one(const Cone& light, Vec3 normal, const Brdf& f, const Incoming& incoming,
                      Rng& rng) {
  carlo::not_implemented("Lab 8.5", "Monte Carlo Path Tracer");
}

}  // namespace lab08
