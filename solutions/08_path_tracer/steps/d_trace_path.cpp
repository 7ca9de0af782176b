#include "path_tracer.h"

// Lab 08, step d: the lecture's TracePath, and its cure. Solved.

namespace lab08 {
namespace {

/// Calls sample() for a surface, with three numbers of the stream.
std::optional<BsdfSample> draw(const Surface& surface, Rng& rng) {
  const float u_lobe = rng.uniform_float();
  const float u = rng.uniform_float();
  const float v = rng.uniform_float();
  return sample(surface.phong(), surface.n, surface.wo, u_lobe, {u, v});
}

}  // namespace

// Lab 8.4 -----------------------------------------------------------------------------------------

float p_emit(const Surface& surface) {
  if (surface.Le == Rgb(0)) return 0;
  const carlo::Phong& phong = surface.phong();
  return phong.kd == Rgb(0) && phong.ks == Rgb(0) ? 1 : 0.9f;
}

Rgb trace_path_lecture(const World& world, const Ray& ray, Rng& rng) {
  const auto surface = world.intersect(ray);
  if (!surface) return world.environment();
  const float p = p_emit(*surface);
  if (rng.uniform_float() < p) return surface->Le / p;
  const auto next = draw(*surface, rng);
  if (!next) return Rgb(0);
  return next->weight * trace_path_lecture(world, world.leave(*surface, next->wi), rng) / (1 - p);
}

Rgb trace_path(const World& world, const Ray& ray, Rng& rng) {
  const auto surface = world.intersect(ray);
  if (!surface) return world.environment();
  const auto next = draw(*surface, rng);
  if (!next) return surface->Le;
  return surface->Le + next->weight * trace_path(world, world.leave(*surface, next->wi), rng);
}

}  // namespace lab08
