#include "bias.h"
#include "course/not_implemented.h"

// Lab 09, step e: radiance from photons. bias.h says what each function takes and returns.

namespace lab09 {

// Lab 9.5 -----------------------------------------------------------------------------------------

Rgb radiance_within(const PhotonMap& map, const Surface& surface, const Brdf& f, float radius) {
  // 1. map.within() calls you for each photon. Which of them arrived on the side that wo is on?
  // 2. The BRDF for the direction that it came from, times its flux. Is there a cosine?
  // 3. Flux becomes irradiance by the area on which it arrived.
  carlo::not_implemented("Lab 9.5", "Summary");
}

Rgb radiance_nearest(const PhotonMap& map, const Surface& surface, const Brdf& f, int k) {
  // 1. map.nearest() has the nearest first. Are there k?
  // 2. The last one says how large the disc is, and adds nothing.
  carlo::not_implemented("Lab 9.5", "Summary");
}

Rgb photon_radiance(const World& world, const Ray& ray, const PhotonMap& all, float radius,
                    Rng& rng) {
  // 1. A loop as in Lab 8.8, with the product of the weights: mirrors and glass by Lab 8.7.
  // 2. The first Phong surface ends it: what it emits, and what it reflects of the photons, with
  //    lab08::evaluate() as BRDF.
  // 3. What is the radiance of a ray that meets nothing?
  carlo::not_implemented("Lab 9.5", "Summary");
}

Rgb caustic_radiance(const World& world, const Ray& ray, const PhotonMap& caustics, float radius,
                     Rng& rng) {
  // 1. The same loop, but it goes on at Phong surfaces, as in Lab 8.7: direct_by_area(), and
  //    sample().
  // 2. And there, photons.
  // 3. Emission that a ray meets was already counted, by direct_by_area() or by the photons: except
  //    which?
  carlo::not_implemented("Lab 9.5", "Summary");
}

}  // namespace lab09
