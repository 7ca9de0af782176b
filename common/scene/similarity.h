#pragma once

#include <glm/glm.hpp>

namespace carlo {

/// p = origin + scale * rotation * q: a rotation or reflection, a uniform scaling and a
/// translation.
struct Similarity {
  glm::dmat3 rotation{1};  ///< orthogonal; its determinant is -1 if it mirrors
  glm::dvec3 origin{0};
  double scale = 1;  ///< > 0

  glm::dvec3 operator()(glm::dvec3 q) const { return origin + scale * (rotation * q); }
  /// The q that maps to p.
  glm::dvec3 inverse(glm::dvec3 p) const { return glm::transpose(rotation) * (p - origin) / scale; }
};

/// First `inner`, then `outer`.
inline Similarity operator*(const Similarity& outer, const Similarity& inner) {
  return {outer.rotation * inner.rotation, outer(inner.origin), outer.scale * inner.scale};
}

}  // namespace carlo
