#pragma once

#include "given/world.h"
#include "numeric/robust.h"

namespace lab09 {

using carlo::Ray;
using carlo::Vec3;

/// The ray that leaves a point of a light in direction d, on the emitting side: as in
/// World::leave(), it starts off the light by as much as rounding demands.
inline Ray leave(const lab08::LightPoint& point, Vec3 d) {
  return {carlo::offset_origin(point.p, point.p_error, point.n, d), d};
}

}  // namespace lab09
