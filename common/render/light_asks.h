#pragma once

#include <algorithm>

namespace carlo {

// What an error bar cannot show: a light that no sample has asked. If a light that brings most of
// the radiance competes with a stronger but hidden one, it is asked as rarely as the integrator
// asks any light (Integrator::least_light_chance), and the noise looks small until it is. A pixel's
// noise is judged together with that of the pixels around it, 12 x 12 in all, as in the reference
// renderer when it stops at a target error.

/// Returns the expected number of times that the least asked light is asked in a pixel and its
/// neighbours, if all of them have this many samples.
inline double expected_asks(double chance, double samples, int width, int height) {
  constexpr int side = 12;
  return chance * samples * std::min(width, side) * std::min(height, side);
}

/// With ten expected asks, one in e^10 such neighbourhoods has not asked the light.
constexpr double enough_asks = 10;

}  // namespace carlo
