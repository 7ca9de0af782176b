#include "path_tracer.h"

// Lab 08, step f: direct light from the lights, indirect light by recursion. Solved.

namespace lab08 {

// Lab 8.6 -----------------------------------------------------------------------------------------

Rgb trace_direct(const World& world, const Ray& ray, bool with_emission, Rng& rng) {
  const auto surface = world.intersect(ray);
  if (!surface) return world.environment();
  const carlo::Phong& phong = surface->phong();
  const auto f = [&](Vec3 wi) { return evaluate(phong, surface->n, surface->wo, wi); };
  Rgb radiance = with_emission ? surface->Le : Rgb(0);
  radiance += direct_by_area(world, *surface, f, rng);
  const float u_lobe = rng.uniform_float();
  const float u = rng.uniform_float();
  const float v = rng.uniform_float();
  const auto next = sample(phong, surface->n, surface->wo, u_lobe, {u, v});
  if (!next) return radiance;
  return radiance + next->weight * trace_direct(world, world.leave(*surface, next->wi), false, rng);
}

}  // namespace lab08
