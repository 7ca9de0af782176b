#pragma once

#include "numeric/vec.h"

#include <functional>
#include <string>
#include <vector>

namespace lab07 {

using carlo::Vec2;
using carlo::Vec3;

/// A floor, z = 0 with normal +z, seen from above, with an object over it. The irradiance or
/// ambient occlusion of every point is known in closed form.
struct Scene {
  std::string name, note;
  bool light = true;    ///< the object shines with radiance 1; otherwise it hides the sky
  float half_size = 1;  ///< the image shows [-half_size, half_size]^2
  /// True if the ray from the floor's point p along wi meets the object.
  std::function<bool(Vec3 p, Vec3 wi)> hit;
  /// The irradiance of light, or the ambient occlusion, at p.
  std::function<double(Vec3 p)> exact;
  Vec3 centre{0};    ///< of the light,
  float radius = 0;  ///< and its size
};

/// A round light under the ceiling; a glowing ball; a ball that lies on the floor; two walls.
std::vector<Scene> scenes();

}  // namespace lab07
