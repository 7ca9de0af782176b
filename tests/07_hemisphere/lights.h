#pragma once

#include "07_hemisphere/places.h"

#include <cmath>
#include <numbers>

// The lights of Lab 7.7: radiance 1 or 0 by direction, with closed forms for the irradiance.

namespace lab07_tests {

enum class Light {
  sky = 0,     ///< 1 everywhere
  ball = 1,    ///< a sphere 2 radii away, at 50 degrees to the normal
  sunset = 2,  ///< the same at 80 degrees, partly below the horizon
  disk = 3,    ///< of radius 1 at height 1, parallel, its centre off by 1/2
  wall = 4,    ///< 1 wide, 1 high, 1 away from the point in front of its corner
  sun = 5      ///< a tiny cone at 60 degrees, as narrow as a lobe of n = 1e7
};

constexpr double sun_angle = 3.5e-4;  ///< its half-angle

/// The direction of balls and suns, in the axes of the normal.
inline Double3 light_centre(Light light) {
  const double theta = light == Light::ball ? 50 : light == Light::sunset ? 80 : 60;
  const double phi = 0.7;
  const double sine = std::sin(theta * pi / 180);
  return {sine * std::cos(phi), sine * std::sin(phi), std::cos(theta * pi / 180)};
}

/// True if light comes from the direction w, given in the axes of the normal.
inline bool lit(Light light, Double3 w) {
  const auto in_cone = [&](double sine) {
    const Double3 centre = light_centre(light);
    const Double3 off = glm::cross(w, centre);
    return glm::dot(w, centre) > 0 && glm::dot(off, off) < sine * sine * glm::dot(w, w);
  };
  switch (light) {
    case Light::sky:
      return true;
    case Light::ball:
    case Light::sunset:
      return in_cone(0.5);
    case Light::disk: {
      const double x = w.x / w.z - 0.5, y = w.y / w.z;
      return w.z > 0 && x * x + y * y < 1;
    }
    case Light::wall:
      // In the plane y = 1, over 0 < x < 1 and 0 < z < 1.
      return w.y > 0 && w.x > 0 && w.x < w.y && w.z > 0 && w.z < w.y;
    case Light::sun:
      return in_cone(std::sin(sun_angle));
  }
  return false;
}

/// The irradiance, in closed form.
inline double exact_irradiance(Light light) {
  switch (light) {
    case Light::sky:
      return pi;
    case Light::ball:
      return pi * std::cos(50 * pi / 180) / 4;
    case Light::sunset: {
      // Part of the sphere is below the horizon: H = 2, theta = 80 degrees.
      const double theta = 80 * pi / 180, c = std::cos(theta), s = std::sin(theta);
      const double x = std::sqrt(3.0), y = -x * c / s, r = std::sqrt(1 - y * y);
      return (c * std::acos(y) - x * s * r) / 4 + std::atan(s * r / x);
    }
    case Light::disk: {
      // R = h = 1, o = 1/2, A = o^2 + h^2.
      const double a = 1.25;
      return pi / 2 * (1 - (a - 1) / std::sqrt((a + 1) * (a + 1) - 1));
    }
    case Light::wall:
      // Height 1, width 1, distance 1.
      return 0.5 * (std::atan(1.0) - std::atan(1 / std::numbers::sqrt2) / std::numbers::sqrt2);
    case Light::sun: {
      const double sine = std::sin(sun_angle);
      return pi * sine * sine * std::cos(60 * pi / 180);
    }
  }
  return 0;
}

}  // namespace lab07_tests
