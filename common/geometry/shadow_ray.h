#pragma once

#include "numeric/robust.h"
#include "scene/camera.h"

namespace carlo {

/// A ray to a point, and the length at which it ends: in front of the point by no more than
/// rounding demands. A fixed distance or fraction would let light through thin covers, or let far
/// lights shade themselves.
struct ShadowRay {
  Ray ray;
  float length;
};

/// From `o`, clear of its own surface, to the point p of a surface with unit normal n and rounding
/// error `p_error` (absolute, per coordinate); n = 0 for a point that lies on no surface. If
/// occluded() leaves out the surface, it cannot be in the ray's way: then `shades_itself` is false,
/// and the ray covers the whole distance.
inline ShadowRay shadow_ray(Vec3 o, Vec3 p, Vec3 p_error, Vec3 n, bool shades_itself = true) {
  // Embree's distances are accurate to a few float roundings.
  const float end = shades_itself ? 1 - 1e-6f : 1;
  const Vec3 target = n == Vec3(0) ? p : offset_origin(p, p_error, n, o - p);
  const Vec3 d = target - o;
  const float length = glm::length(d);
  return {{o, d / length}, length * end};
}

}  // namespace carlo
