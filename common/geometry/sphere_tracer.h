#pragma once

#include "numeric/vec.h"
#include "scene/sdf.h"

namespace carlo {

/// Intersects rays with an Sdf by sphere tracing: since F has the Lipschitz bound 1, a step of |F|
/// cannot pass the surface. Source: Hart, "Sphere tracing: a geometric method for the antialiased
/// ray tracing of implicit surfaces", 1996.
///
/// Everything is in double and in units of the sdf, so that the scale and position of the scene do
/// not matter. A hit is a change of F's sign, narrowed to the precision of double. Steps near the
/// surface are at least 1e-6 of the sdf's size, so a ray that is inside for less than that may
/// miss. After every 512 steps the least step doubles, so that a ray along the surface ends too:
/// none takes more than about 11000 steps, and only rays of more than 512 steps are less precise.
class SphereTracer {
 public:
  explicit SphereTracer(const Sdf& sdf);

  /// The nearest t in (tnear, tfar) at which the ray o + t d, |d| = 1, meets the surface, from
  /// either side; a negative value if there is none. A ray that starts on the surface, within
  /// double's precision, does not meet it at its start, unless it is inside for less than a least
  /// step there.
  double intersect(Vec3 o, Vec3 d, float tnear, float tfar) const;

  struct Point {
    Vec3 p, p_error, n;
  };
  /// The surface point at the t that intersect() found, a bound on the rounding error of each
  /// coordinate, and the unit normal.
  Point point(Vec3 o, Vec3 d, double t) const;

  /// In sizes of the sdf; and the number of steps after which it doubles.
  static constexpr double least_step = 1e-6;
  static constexpr int steps_to_doubling = 512;

  /// A box that holds the surface, in the sdf's coordinates, with room for rounding; half of the
  /// surface's own diagonal; and the largest distance of the box from the origin.
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
  double reach_;  // the largest distance of the box from the origin
  Vec3 lower_, upper_;
};

}  // namespace carlo
