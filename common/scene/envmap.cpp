#include "scene/envmap.h"

#include "numeric/robust.h"

#include <algorithm>
#include <cmath>

namespace carlo {

std::size_t texel_at(const Envmap& map, Vec3 d) {
  const glm::dvec3 v = glm::transpose(map.rotation) * glm::dvec3(d);
  // atan2, since next to the poles acos would lose half of the digits.
  const double around = std::atan2(v.x, -v.z) / (2 * pi);
  const double down = std::atan2(std::hypot(v.x, v.z), v.y) / pi;
  const double s = around < 0 ? around + 1 : around;
  return map.image.index(std::min(static_cast<int>(s * map.image.width), map.image.width - 1),
                         std::min(static_cast<int>(down * map.image.height), map.image.height - 1));
}

}  // namespace carlo
