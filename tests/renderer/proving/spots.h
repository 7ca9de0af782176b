#pragma once

#include "proving/parts.h"

#include <glm/glm.hpp>

namespace proving {

/// A lamp above the origin and the irradiance that it gives a surface there with normal +y.
struct Lamp {
  const char* name;
  carlo::Shape shape;  ///< radiance 1
  double irradiance;
};

/// A ball, disks, rectangles, triangles; a unit or so from the origin. See spots.cpp for the forms.
std::vector<Lamp> lamps();

/// Sees a spot at the origin of 7e-5 to either side: over it, irradiance is that at the origin but
/// for 1e-8. The line of sight comes from (.6, .5, .3) and is clear of all lamps().
carlo::Camera spot_camera();

/// What float coordinates may change of the radiance of a spot, relative: moved by `shift` sizes,
/// they round by up to 2^-24 of that, and irradiance changes by a few times as much.
double spot_rounding(double shift);

/// As in the finish, with radiances that differ: by `strength` and colour.
carlo::Shape lit(carlo::Shape lamp, std::uint32_t material, carlo::Rgb radiance);

}  // namespace proving
