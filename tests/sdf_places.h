#pragma once

// Directions and places for tests of signed distance functions.

#include "random/rng.h"
#include "scene/similarity.h"

#include <cmath>

namespace sdf_places {

inline glm::dvec3 random_direction(carlo::Rng& rng) {
  for (;;) {
    glm::dvec3 v;
    for (int i = 0; i < 3; ++i)
      v[i] = 2 * rng.uniform() - 1;
    const double r = glm::length(v);
    if (r > 0.1 && r < 1) return v / r;
  }
}

/// About x, then about z.
inline carlo::Similarity turned(double angle, glm::dvec3 origin = glm::dvec3(0), double scale = 1) {
  const double c = std::cos(angle), s = std::sin(angle);
  const glm::dmat3 about_z({c, s, 0}, {-s, c, 0}, {0, 0, 1});
  const glm::dmat3 about_x({1, 0, 0}, {0, c, s}, {0, -s, c});
  return {about_z * about_x, origin, scale};
}

}  // namespace sdf_places
