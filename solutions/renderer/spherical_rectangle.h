#pragma once

#include "numeric/vec.h"
#include "scene/scene.h"

namespace renderer {

using carlo::Vec2;
using carlo::Vec3;

/// A rectangle in its own frame, precomputed.
struct RectangleFrame {
  glm::dvec3 origin, x, y, z;  ///< x along u, y along v
  double width, height;

  /// Needs u perpendicular to v, both of positive length.
  explicit RectangleFrame(const carlo::Parallelogram& rectangle);
};

/// A rectangle seen from a point, ready to be sampled uniformly by solid angle. Area sampling has
/// unbounded variance when the point comes close to the rectangle's plane or edge; this has none.
/// Source: Urena, Fajardo, King, "An area-preserving parametrization for spherical rectangles",
/// EGSR 2013.
class SphericalRectangle {
 public:
  SphericalRectangle(const RectangleFrame& rectangle, Vec3 from);

  /// Steradians; 0 when seen edge-on.
  double solid_angle() const { return solid_angle_; }

  /// A point of the rectangle; the directions to such points have density 1 / solid_angle().
  Vec3 sample(Vec2 u) const;

 private:
  glm::dvec3 origin_, x_, y_;      ///< the rectangle's corner and sides
  double x0_, x1_, y0_, y1_, z0_;  ///< in a frame with its origin at the point; z0 < 0
  double b0_, b1_, k_, solid_angle_;
};

}  // namespace renderer
