#pragma once

#include "given/world.h"
#include "numeric/robust.h"

namespace lab09 {

using carlo::Ray;
using carlo::Rgb;
using carlo::Vec3;

/// The luminance of linear RGB. Source: ITU-R BT.709.
inline float luminance(Rgb c) {
  return 0.2126f * c.r + 0.7152f * c.g + 0.0722f * c.b;
}

/// The ray that leaves a point of a light in direction d, on the side that emits: as
/// World::leave(), it starts off the light by as much as rounding asks for.
inline Ray leave(const lab08::LightPoint& point, Vec3 d) {
  return {carlo::offset_origin(point.p, point.p_error, point.n, d), d};
}

}  // namespace lab09
