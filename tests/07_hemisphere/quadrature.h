#pragma once

#include "07_hemisphere/places.h"

#include <cmath>
#include <vector>

namespace lab07_tests {

/// Calls f with directions around an axis, up to the angle whose 1 - cos is `reach`, and with the
/// solid angle that each represents: the midpoint rule.
template <class F>
void over_directions(Double3 axis, double reach, const F& f) {
  constexpr int rings = 500, sectors = 500;
  static const std::vector<Double3> turns = [] {
    std::vector<Double3> all;
    for (int k = 0; k < sectors; ++k) {
      const double phi = 2 * pi * (k + 0.5) / sectors;
      all.emplace_back(std::cos(phi), std::sin(phi), 0);
    }
    return all;
  }();
  const Axes axes(axis);
  const double solid_angle = reach * 2 * pi / (rings * static_cast<double>(sectors));
  for (int i = 0; i < rings; ++i) {
    const double h = reach * (i + 0.5) / rings;  // 1 - cos
    const double sine = std::sqrt(h * (2 - h));
    for (const Double3& turn : turns)
      f(axes.world({sine * turn.x, sine * turn.y, 1 - h}), solid_angle);
  }
}

}  // namespace lab07_tests
