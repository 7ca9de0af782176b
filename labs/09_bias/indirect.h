#pragma once

#include "bias.h"

#include <cmath>

namespace lab09 {

/// The result of a record's ray, for irradiance by indirect light alone: light that was reflected
/// before it arrives, or came through mirrors or glass. By lab 8's paths.
inline Arrival indirect_arrival(const World& world, const Ray& ray, Rng& rng) {
  const auto met = world.intersect(ray);
  const double distance = met ? static_cast<double>(glm::length(met->p - ray.o)) : INFINITY;
  return {lab08::trace_specular(world, ray, false, rng), distance};
}

}  // namespace lab09
