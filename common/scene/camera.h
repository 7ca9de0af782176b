#pragma once

#include "numeric/vec.h"

namespace carlo {

struct Ray {
  Vec3 o;
  Vec3 d;  ///< of length 1
};

/// A pinhole camera.
struct Camera {
  Vec3 origin{0};
  Vec3 right{1, 0, 0}, up{0, 1, 0}, forward{0, 0, -1};  ///< orthonormal
  float tan_half_x = 1, tan_half_y = 1;  ///< half the film's width and height at distance 1

  /// The ray through a point of the film; (0, 0) is the film's top left corner, (1, 1) its bottom
  /// right one.
  Ray ray(Vec2 film) const {
    const Vec3 d =
        forward + (2 * film.x - 1) * tan_half_x * right + (1 - 2 * film.y) * tan_half_y * up;
    return {origin, glm::normalize(d)};
  }
};

}  // namespace carlo
