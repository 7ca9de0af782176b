#include "course/not_implemented.h"
#include "hemisphere.h"
#include "path_tracer.h"

#include <algorithm>
#include <cmath>

// Lab 08, step g: mirrors and glass. path_tracer.h says what each function takes and returns.

namespace lab08 {

// Lab 8.7 -----------------------------------------------------------------------------------------

float fresnel(float cos_i, float eta) {
  carlo::not_implemented("Lab 8.7", "Monte Carlo Path Tracer");
}

std::optional<Vec3> refract(Vec3 normal, Vec3 wo, float eta) {
  carlo::not_implemented("Lab 8.7", "Monte Carlo Path Tracer");
}

BsdfSample sample_mirror(const carlo::Mirror& mirror, const Surface& surface) {
  carlo::not_implemented("Lab 8.7", "Monte Carlo Path Tracer");
}

BsdfSample sample_glass(const carlo::Dielectric& glass, const Surface& surface, float u) {
  carlo::not_implemented("Lab 8.7", "Monte Carlo Path Tracer");
}

Rgb trace_specular(const World& world, const Ray& ray, bool with_emission, Rng& rng) {
  carlo::not_implemented("Lab 8.7", "Monte Carlo Path Tracer");
}

}  // namespace lab08
