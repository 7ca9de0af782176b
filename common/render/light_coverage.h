#pragma once

#include <algorithm>

namespace carlo {

// An error bar cannot show a light that has never been sampled. A visible light that competes with
// a stronger but occluded one may be sampled as rarely as the integrator samples any light
// (Integrator::least_light_probability), and until then the noise looks small. Pixels are judged
// together with their neighbours, 12 x 12 in all, as by renders with a target error.

/// Returns the expected number of times that the least sampled light is sampled in a pixel and its
/// neighbours, if all of them have this many samples.
inline double expected_light_samples(double probability, double samples, int width, int height) {
  constexpr int side = 12;
  return probability * samples * std::min(width, side) * std::min(height, side);
}

/// With ten expected samples, one such neighbourhood in e^10 has missed the light.
constexpr double enough_light_samples = 10;

}  // namespace carlo
