#include "bias.h"
#include "course/not_implemented.h"

// Lab 09, step e: radiance from photons. bias.h says what each function takes and returns.

namespace lab09 {

// Lab 9.5 -----------------------------------------------------------------------------------------

Rgb radiance_within(const PhotonMap& map, const Surface& surface, const Brdf& f, float radius) {
  carlo::not_implemented("Lab 9.5", "Summary");
}

Rgb radiance_nearest(const PhotonMap& map, const Surface& surface, const Brdf& f, int k) {
  carlo::not_implemented("Lab 9.5", "Summary");
}

Rgb photon_radiance(const World& world, const Ray& ray, const PhotonMap& all, float radius,
                    Rng& rng) {
  carlo::not_implemented("Lab 9.5", "Summary");
}

Rgb caustic_radiance(const World& world, const Ray& ray, const PhotonMap& caustics, float radius,
                     Rng& rng) {
  carlo::not_implemented("Lab 9.5", "Summary");
}

}  // namespace lab09
