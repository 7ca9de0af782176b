#pragma once

#include "proving/parts.h"

#include <glm/glm.hpp>

namespace proving {

/// A light above the origin and its irradiance on a surface there with normal +y.
struct Light {
  const char* name;
  carlo::Shape shape;  ///< radiance 1
  double irradiance;
};

/// A ball, disks, rectangles, triangles; about one unit from the origin. See spots.cpp for the
/// closed forms.
std::vector<Light> lights();

/// Sees a spot at the origin, 7e-5 to either side: within it irradiance is constant up to 1e-8. The
/// line of sight comes from (.6, .5, .3) and is clear of all lights().
carlo::Camera spot_camera();

/// The possible relative effect of float coordinates on the radiance of a spot: moved by `shift`
/// sizes, they are rounded by up to 2^-24 of that, and irradiance changes by a few times as much.
double spot_rounding(double shift);

/// Returns the light with this material and radiance.
carlo::Shape lit(carlo::Shape light, std::uint32_t material, carlo::Rgb radiance);

}  // namespace proving
