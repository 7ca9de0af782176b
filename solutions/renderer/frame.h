#pragma once

#include "numeric/vec.h"

#include <cmath>

namespace renderer {

using carlo::Vec2;
using carlo::Vec3;

/// Two unit vectors that make (s, t, n) a right-handed orthonormal frame; |n| = 1.
/// Source: Duff et al., "Building an orthonormal basis, revisited", JCGT 6(1), 2017: exact to
/// rounding for every n, where Frisvad's version breaks down near n.z = -1.
struct Frame {
  Vec3 s, t, n;

  explicit Frame(Vec3 normal) : n(normal) {
    const float sign = std::copysign(1.0f, n.z);
    const float a = -1 / (sign + n.z);
    const float b = n.x * n.y * a;
    s = {1 + sign * n.x * n.x * a, sign * b, -sign * n.x};
    t = {b, sign + n.y * n.y * a, -n.y};
  }

  Vec3 to_world(Vec3 local) const { return local.x * s + local.y * t + local.z * n; }
};

}  // namespace renderer
