#include "course/not_implemented.h"
#include "hemisphere.h"
#include "numeric/robust.h"
#include "path_tracer.h"

#include <algorithm>
#include <cmath>

// Lab 08, step c: Lafortune's modified Phong BRDF. path_tracer.h says what each function takes and
// returns.

namespace lab08 {

// Lab 8.3 -----------------------------------------------------------------------------------------

Rgb evaluate(const carlo::Phong& phong, Vec3 normal, Vec3 wo, Vec3 wi) {
  // 1. Below the horizon: 0.
  // 2. The mirror direction of wo, in the world.
  // 3. cos^n(alpha): 0 from 90 degrees on; and where wi is nearly the mirror direction, the dot
  //    product is not accurate enough. pdf() needs the same power: make it a function.
  // 4. The lecture's formula. No cosine at the surface.
  carlo::not_implemented("Lab 8.3", "Reflected Ray Sampling");
}

LobeProbabilities lobe_probabilities(const carlo::Phong& phong) {
  // 1. The largest channel of each of the two reflectances.
  // 2. Chances do not add up to more than 1.
  carlo::not_implemented("Lab 8.3", "Reflected Ray Sampling");
}

std::optional<BsdfSample> sample(const carlo::Phong& phong, Vec3 normal, Vec3 wo, float u_lobe,
                                 Vec2 u) {
  // 1. u_lobe decides: diffuse, specular or absorbed, each with its chance.
  // 2. Make the direction by lab 7, in the normal's frame: its lobe wants wo there too.
  // 3. Back to the world, of length 1. Below the horizon: nothing.
  // 4. The weight divides by the density with which this direction is drawn by either lobe.
  carlo::not_implemented("Lab 8.3", "Reflected Ray Sampling");
}

float pdf(const carlo::Phong& phong, Vec3 normal, Vec3 wo, Vec3 wi) {
  // 1. Below the horizon: 0.
  // 2. Each lobe's own density (lab 7) times the chance of the lobe; add them. Mind n + 1 and n +
  //    2.
  carlo::not_implemented("Lab 8.3", "Reflected Ray Sampling");
}

}  // namespace lab08
