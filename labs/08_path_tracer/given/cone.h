#pragma once

#include "numeric/vec.h"

namespace lab08 {

using carlo::Vec2;
using carlo::Vec3;

/// The directions in which a sphere is seen from a point outside: all those within an angle beta of
/// an axis. Stores 1 - cos(beta), since for small lights the cosine itself rounds to 1.
struct Cone {
  Vec3 axis{0, 0, 1};  ///< of length 1
  float one_minus_cos = 0;

  /// Uniform in the cone, from u in [0, 1)^2.
  Vec3 sample(Vec2 u) const;
  /// True if a unit vector lies in the cone.
  bool contains(Vec3 w) const;
  /// 2 pi (1 - cos beta).
  float solid_angle() const;
  /// The solid angle of the part that lies above the horizon of a unit normal.
  float solid_angle_above(Vec3 normal) const;
};

/// The cone in which the sphere is seen; `from` lies outside the sphere.
Cone cone_of(Vec3 center, float radius, Vec3 from);

}  // namespace lab08
