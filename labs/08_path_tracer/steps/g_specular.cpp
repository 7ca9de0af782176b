#include "course/not_implemented.h"
#include "path_tracer.h"

#include <cmath>

// Lab 08, step g: mirrors and glass. path_tracer.h says what each function takes and returns.

namespace lab08 {

// Lab 8.7 -----------------------------------------------------------------------------------------

float fresnel(float cos_i, float eta) {
  // 1. Snell's law gives the sine beyond the boundary. From 1 on: total internal reflection.
  // 2. Fresnel's two formulas, one for each polarisation, from the two cosines.
  // 3. Unpolarised light is half of each, and the formulas are of amplitudes: power is the square.
  carlo::not_implemented("Lab 8.7", "Monte Carlo Path Tracer");
}

std::optional<Vec3> refract(Vec3 normal, Vec3 wo, float eta) {
  // 1. The sine beyond, as above; nothing where there is no refraction.
  // 2. Split wo into a part along the normal and a part across. Snell's law scales the part across,
  //    and both parts change sides.
  // 3. Rounding: return length 1.
  carlo::not_implemented("Lab 8.7", "Monte Carlo Path Tracer");
}

BsdfSample sample_mirror(const carlo::Mirror& mirror, const Surface& surface) {
  // 1. The mirror direction about the surface's normal, of length 1. No density, no cosine: what is
  //    left of the BSDF?
  carlo::not_implemented("Lab 8.7", "Monte Carlo Path Tracer");
}

BsdfSample sample_glass(const carlo::Dielectric& glass, const Surface& surface, float u) {
  // 1. Which index is on wo's side? surface.front tells.
  // 2. u against fresnel(): a choice with probability F, whose weight has the factor F, too.
  // 3. Refraction changes the solid angle of a pencil of light, and radiance is per solid angle.
  carlo::not_implemented("Lab 8.7", "Monte Carlo Path Tracer");
}

Rgb trace_specular(const World& world, const Ray& ray, bool with_emission, Rng& rng) {
  // 1. Phong surfaces: as in trace_direct().
  // 2. Mirrors and glass: no direct light, one direction.
  // 3. Recursion. Has a light been sampled for what the next ray meets?
  carlo::not_implemented("Lab 8.7", "Monte Carlo Path Tracer");
}

}  // namespace lab08
