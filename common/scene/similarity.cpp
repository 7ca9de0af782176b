#include "scene/similarity.h"

#include "scene/transforms.h"

#include <cmath>

namespace carlo {

std::optional<Similarity> similarity(const glm::dmat4& transform) {
  const glm::dmat3 linear(transform);
  for (int i = 0; i < 3; ++i) {
    if (!equal_and_orthogonal(linear[i], linear[(i + 1) % 3])) return {};
  }
  const glm::dvec3 x = glm::normalize(linear[0]);
  const glm::dvec3 y = glm::normalize(linear[1] - glm::dot(linear[1], x) * x);
  const glm::dvec3 z = (mirrors(transform) ? -1.0 : 1.0) * glm::cross(x, y);
  const double scale = std::cbrt(std::abs(glm::determinant(linear)));
  return Similarity{glm::dmat3(x, y, z), glm::dvec3(transform[3]), scale};
}

}  // namespace carlo
