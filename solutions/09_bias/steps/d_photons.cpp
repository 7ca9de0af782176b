#pragma GCC diagnostic ignored "-Wunused-parameter"  // until it is solved
#include "bias.h"
#include "course/not_implemented.h"

// Lab 09, step d: photons from the lamps. bias.h says what each function takes and returns.

namespace lab09 {

// Lab 9.4 -----------------------------------------------------------------------------------------

Emission emit_from_point(Vec3 p, Rgb intensity, Rng& rng) {
  carlo::not_implemented("Lab 9.4", "Summary");
}

Emission emit_from_light(const Light& light, Rng& rng) {
  carlo::not_implemented("Lab 9.4", "Summary");
}

Emission emit_photon(const World& world, Rng& rng) {
  carlo::not_implemented("Lab 9.4", "Summary");
}

void trace_photon(const World& world, const Emission& emission, Rng& rng,
                  const std::function<void(const Photon&)>& store) {
  carlo::not_implemented("Lab 9.4", "Summary");
}

}  // namespace lab09
