#include "hemisphere.h"
#include "numeric/robust.h"
#include "path_tracer.h"

#include <cmath>

// Lab 08, step b: light that comes straight from a light. Solved.

namespace lab08 {

// Lab 8.2 -----------------------------------------------------------------------------------------

Rgb direct_by_area(const World& world, const Surface& surface, const Brdf& f, Rng& rng) {
  if (world.lights().empty()) return Rgb(0);
  const Light& light = world.choose(rng.uniform_float());
  const float u = rng.uniform_float();
  const float v = rng.uniform_float();
  const LightPoint point = light.sample({u, v});
  const Vec3 d = point.p - surface.p;
  const float distance2 = glm::dot(d, d);
  const Vec3 wi = d / std::sqrt(distance2);
  const float cos_surface = glm::dot(surface.n, wi), cos_light = -glm::dot(point.n, wi);
  if (!(cos_surface > 0 && cos_light > 0) || !world.sees(surface, point)) return Rgb(0);
  const float inverse_density = light.area() / light.chance();
  return f(wi) * point.radiance * (cos_surface * cos_light / distance2 * inverse_density);
}

Rgb direct_by_hemisphere(const World& world, const Surface& surface, const Brdf& f, Rng& rng) {
  const float u = rng.uniform_float();
  const float v = rng.uniform_float();
  const Vec3 local = lab07::sample_cosine_hemisphere({u, v});
  const Vec3 wi = lab07::Frame(surface.n).to_world(local);
  const auto met = world.intersect(world.leave(surface, wi));
  if (!met) return Rgb(0);
  // The cosine cancels that of the density.
  return f(wi) * met->Le * carlo::pi_f;
}

}  // namespace lab08
