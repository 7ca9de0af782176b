#include "bias.h"
#include "course/not_implemented.h"
#include "hemisphere.h"

#include <cmath>

// Lab 09, step d: photons. bias.h says what each function takes and returns.

namespace lab09 {

// Lab 9.4 -----------------------------------------------------------------------------------------

Emission emit_from_point(Vec3 p, Rgb intensity, Rng& rng) {
  // 1. A uniform direction of the whole sphere: two numbers, a statement each.
  // 2. Its flux: the intensity is power per solid angle.
  carlo::not_implemented("Lab 9.4", "Summary");
}

Emission emit_from_light(const Light& light, Rng& rng) {
  // 1. A uniform point: light.sample().
  // 2. Radiance is the same in all directions, but a slanted pencil of light is thinner. Which of
  //    lab 7's samplers has a density that makes up for that?
  // 3. The ray starts beside the light: leave(point, d) of bias.h.
  // 4. The flux is the light's power: radiance, integrated over its area and the hemisphere. The
  //    radiance is the same at all points: any light.sample() has it.
  carlo::not_implemented("Lab 9.4", "Summary");
}

Emission emit_photon(const World& world, Rng& rng) {
  // 1. One number for world.choose(), which says what light.
  // 2. What is chosen with a chance is divided by it.
  carlo::not_implemented("Lab 9.4", "Summary");
}

void trace_photon(const World& world, const Emission& emission, Rng& rng,
                  const std::function<void(const Photon&)>& store) {
  // 1. A loop of at most lab08::longest_path segments: the nearest surface; without one, the end.
  // 2. Phong: store the photon, with what it has met so far. Then sample(), three numbers.
  // 3. Mirror or glass: store nothing, but count it.
  // 4. Multiply the flux by the weight. Does glass's weight belong to flux?
  // 5. Go on along world.leave().
  carlo::not_implemented("Lab 9.4", "Summary");
}

}  // namespace lab09
