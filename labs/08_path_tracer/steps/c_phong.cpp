#include "course/not_implemented.h"
#include "hemisphere.h"
#include "path_tracer.h"

#include <algorithm>
#include <cmath>

// Lab 08, step c: Lafortune's modified Phong BRDF. path_tracer.h says what each function takes and
// returns.

namespace lab08 {

// Lab 8.3 -----------------------------------------------------------------------------------------

Rgb evaluate(const carlo::Phong& phong, Vec3 normal, Vec3 wo, Vec3 wi) {
  carlo::not_implemented("Lab 8.3", "Reflected Ray Sampling");
}

LobeChances lobe_chances(const carlo::Phong& phong) {
  carlo::not_implemented("Lab 8.3", "Reflected Ray Sampling");
}

std::optional<BsdfSample> sample(const carlo::Phong& phong, Vec3 normal, Vec3 wo, float u_lobe,
                                 Vec2 u) {
  carlo::not_implemented("Lab 8.3", "Reflected Ray Sampling");
}

float pdf(const carlo::Phong& phong, Vec3 normal, Vec3 wo, Vec3 wi) {
  carlo::not_implemented("Lab 8.3", "Reflected Ray Sampling");
}

}  // namespace lab08
