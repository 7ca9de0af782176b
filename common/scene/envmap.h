#pragma once

#include "image/image.h"
#include "numeric/vec.h"

#include <cstddef>

namespace carlo {

/// An image all around the scene, infinitely far away: the radiance that arrives from the
/// directions that meet no shape. It is a latitude-longitude image in the convention of Mitsuba
/// 0.6's `envmap`: in the image's own coordinates the direction (x, y, z), of length 1, stands at
///
///   s = atan2(x, -z) / (2 pi), t = acos(y) / pi
///
/// of its width and height. The top row is around +y, the left edge is towards -z and a quarter of
/// the width to the right of it is +x. A texel has one radiance for all of its directions: they are
/// those of its part of the sphere, and nothing is interpolated.
struct Envmap {
  Image image;             ///< radiances >= 0
  glm::dmat3 rotation{1};  ///< orthogonal: from the image's coordinates to the scene's; may mirror
};

/// Which of the image's pixels stands in direction d of the scene, of length 1.
std::size_t texel_at(const Envmap& map, Vec3 d);

}  // namespace carlo
