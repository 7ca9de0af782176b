#pragma once

#include "numeric/vec.h"

namespace carlo {

struct Ray {
  Vec3 o;
  Vec3 d;  ///< of length 1
};

/// The side of the film that the field of view spans.
enum class FovAxis { x, y, smaller, larger };

/// A pinhole camera.
struct Camera {
  Vec3 origin{0};
  Vec3 right{1, 0, 0}, up{0, 1, 0}, forward{0, 0, -1};  ///< orthonormal
  FovAxis fov_axis = FovAxis::x;
  float tan_half_fov = 1;                ///< half of the spanned side at distance 1
  float tan_half_x = 1, tan_half_y = 1;  ///< half the film's width and height at distance 1

  /// Sets tan_half_x and tan_half_y for a film of this many square pixels.
  void fit_film(int width, int height) {
    const float aspect = static_cast<float>(width) / static_cast<float>(height);
    const bool across_width = fov_axis == FovAxis::x ||
                              (fov_axis == FovAxis::smaller && aspect <= 1) ||
                              (fov_axis == FovAxis::larger && aspect >= 1);
    tan_half_x = across_width ? tan_half_fov : tan_half_fov * aspect;
    tan_half_y = across_width ? tan_half_fov / aspect : tan_half_fov;
  }

  /// The ray through a point of the film; (0, 0) is the film's top left corner, (1, 1) its bottom
  /// right one.
  Ray ray(Vec2 film) const {
    const Vec3 d =
        forward + (2 * film.x - 1) * tan_half_x * right + (1 - 2 * film.y) * tan_half_y * up;
    return {origin, glm::normalize(d)};
  }
};

}  // namespace carlo
