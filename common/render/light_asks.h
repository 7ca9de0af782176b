#pragma once

#include <algorithm>

namespace carlo {

// What an error bar cannot know: a light that no sample has asked. Where one that brings most of
// the light stands behind another that is stronger but hidden, it is asked as seldom as an
// integrator asks any light (Integrator::least_light_chance), and until it has been the noise looks
// small. A pixel's noise is looked at together with that of the pixels around it, 12 x 12 in all,
// as the reference renderer does that stops at a target error.

/// How often a light is asked that is asked the least, in a pixel and those around it that have as
/// many samples: the expected number.
inline double expected_asks(double chance, double samples, int width, int height) {
  constexpr int side = 12;
  return chance * samples * std::min(width, side) * std::min(height, side);
}

/// With ten expected, one in e^10 such neighbourhoods has not asked it.
constexpr double enough_asks = 10;

}  // namespace carlo
