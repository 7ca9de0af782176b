#pragma once

#include "numeric/vec.h"
#include "scene/sdf.h"

namespace carlo {

/// Finds where rays meet an Sdf by sphere tracing: since F has the Lipschitz bound 1, a step of |F|
/// cannot pass the surface.
/// Source: Hart, "Sphere tracing: a geometric method for the antialiased ray tracing of implicit
/// surfaces", 1996.
///
/// All is done in double and in units of the sdf, so that the scale and the place of the scene do
/// not matter. A hit is a change of F's sign, narrowed to the precision of double: near the surface
/// steps are at least 1e-6 of the sdf's size, and a ray that is inside for less than such a step
/// may miss. After each 512 steps the least step doubles, so that a ray along the surface comes to
/// its end too: none takes more than some 11000 steps, and only one of more than 512 looks less
/// closely.
class SphereTracer {
 public:
  explicit SphereTracer(const Sdf& sdf);

  /// The nearest t in (tnear, tfar) at which the ray o + t d, |d| = 1, meets the surface, from
  /// either side; a negative value if there is none. A ray that starts on the surface, within
  /// double's precision, does not meet it at its start, unless that is all it is inside for: less
  /// than a least step.
  double intersect(Vec3 o, Vec3 d, float tnear, float tfar) const;

  struct Point {
    Vec3 p, p_error, n;
  };
  /// The surface point at the t that intersect() found, a bound on the rounding error of each
  /// coordinate, and the unit normal.
  Point point(Vec3 o, Vec3 d, double t) const;

  /// In sizes of the sdf; and after how many steps it doubles.
  static constexpr double least_step = 1e-6;
  static constexpr int steps_to_doubling = 512;

  /// A box that holds the surface, in the sdf's coordinates, with room for rounding; half of the
  /// surface's own diagonal; and the farthest that a point of the box is from the origin.
  const sdf::Box& box() const { return box_; }
  double size() const { return size_; }
  double reach() const { return reach_; }

  /// The corners of a box in world space that holds the surface.
  Vec3 lower() const { return lower_; }
  Vec3 upper() const { return upper_; }

 private:
  struct LocalRay;
  LocalRay to_local(Vec3 o, Vec3 d) const;
  double resolution(glm::dvec3 o) const;
  double first_root(const LocalRay& ray, double begin, double end, bool starts_outside) const;
  double narrowed(const LocalRay& ray, double a, double b, double f_a, double f_b) const;

  Sdf sdf_;
  sdf::Box box_;  // in the sdf's coordinates
  double size_;   // half of that box's diagonal
  double reach_;  // the farthest that a point of the box is from the origin
  Vec3 lower_, upper_;
};

}  // namespace carlo
