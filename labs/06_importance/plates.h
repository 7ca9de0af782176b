#pragma once

#include "importance.h"

#include <array>

namespace lab06 {

// Veach's plates in one dimension. Directions are numbers x; four lights of equal power lie along
// the line, from a point to a panel; four plates reflect, from nearly mirror-like to nearly matt. A
// pixel looks in the mirror direction m and sees the lights blurred by the plate's lobe around m.

struct Light {
  double centre, half_width;
  double radiance() const { return 1 / (2 * half_width); }
};

constexpr std::array<Light, 4> plate_lights = {
    {{0.125, 0.0008}, {0.375, 0.005}, {0.625, 0.025}, {0.86, 0.09}}};
/// The scales of the plates' lobes.
constexpr std::array<double, 4> plate_scales = {0.0006, 0.003, 0.012, 0.05};

/// The radiance from direction x times the lobe of the plate around m.
Function plate_integrand(double m, double scale);
/// Its integral.
double plate_exact(double m, double scale);

/// The two techniques: choose a light, then a point on it; or draw a direction from the lobe.
Density light_technique();
Density lobe_technique(double m, double scale);

}  // namespace lab06
