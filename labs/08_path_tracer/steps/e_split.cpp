#include "course/not_implemented.h"
#include "hemisphere.h"
#include "numeric/robust.h"
#include "path_tracer.h"

// Lab 08, step e: one ray to the light and one elsewhere. path_tracer.h says what each function
// takes and returns.

namespace lab08 {

// Lab 8.5 -----------------------------------------------------------------------------------------

Rgb reflect_split(const Cone& light, Vec3 normal, const Brdf& f, const Incoming& incoming,
                  Rng& rng) {
  // 1. A uniform direction of the cone. Which density does it have? It may lie below the horizon:
  //    then it contributes nothing, and incoming() must not be called.
  // 2. A uniform direction of the hemisphere (lab 7), drawn again until it is outside of the cone.
  //    How large is the set that it is uniform in? Part of the cone may not be in the hemisphere.
  // 3. Each contributes f incoming cosine over its own density; two integrals, one sum.
  carlo::not_implemented("Lab 8.5", "Monte Carlo Path Tracer");
}

Rgb reflect_split_one(const Cone& light, Vec3 normal, const Brdf& f, const Incoming& incoming,
                      Rng& rng) {
  // 1. Toss the coin first.
  // 2. Trace one direction of the two above. It came with probability 1/2.
  carlo::not_implemented("Lab 8.5", "Monte Carlo Path Tracer");
}

}  // namespace lab08
