#pragma once

#include "image/image.h"
#include "numeric/vec.h"

#include <cstddef>

namespace carlo {

/// An environment map, infinitely far away: the radiance from directions that meet no
/// shape. It is a latitude-longitude image in the convention of Mitsuba 0.6's `envmap`: in the
/// image's own coordinates the unit direction (x, y, z) stands at
///
///   s = atan2(x, -z) / (2 pi), t = acos(y) / pi
///
/// of its width and height. The top row is around +y, the left edge is towards -z, and +x is a
/// quarter of the width to the right of it. A texel has the same radiance for all directions of its
/// part of the sphere; nothing is interpolated.
struct Envmap {
  Image image;             ///< radiances >= 0
  glm::dmat3 rotation{1};  ///< orthogonal: maps the image's coordinates to the scene's; may mirror
};

/// The index of the image's pixel in the unit direction d of the scene.
std::size_t texel_at(const Envmap& map, Vec3 d);

}  // namespace carlo
