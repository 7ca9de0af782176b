#pragma once

#include "scene/sdf.h"

#include <array>
#include <vector>

namespace renderer {

/// A bound on the second derivative of a signed distance function F along lines (per unit of its
/// coordinates), and the values of F up to which it holds.
struct Bend {
  double most;
  double reach;
};

/// F'' >= -result along every line wherever F < reach, reach > 0; infinity where there is no bound.
/// It is 0 outside convex shapes; a crease that points outwards does not count, since F' only rises
/// there.
double bend_below(const carlo::Sdf& sdf, double reach);
/// F'' <= result wherever F > -reach.
double bend_above(const carlo::Sdf& sdf, double reach);

/// The bound whose reach gives sphere tracing the longest steps from the surface of an sdf of this
/// size; a reach of 0 if there is none.
Bend bend_below_near(const carlo::Sdf& sdf, double size);
Bend bend_above_near(const carlo::Sdf& sdf, double size);

/// A signed distance function as the vector kernels read it: carlo::Sdf's steps, with kinds as
/// numbers and everything that does not depend on the point precomputed. All in double, as in the
/// SphereTracer.
struct LaneSdf {
  enum class Part { ball, torus, rounded_box, capsule, gyroid, unite, intersect, subtract };

  /// The last three combine other parts and use only the smoothing.
  struct Step {
    Part part;
    /// A form's own coordinates are turn (p - origin) of the sdf's; its distance is multiplied by
    /// `scale`.
    glm::dmat3 turn{1};
    glm::dvec3 origin{0};
    double scale = 1;
    /// ball: radius. torus: major, minor. rounded_box: radius; `a` the half sides of the inner box.
    /// capsule: radius; from `a` along `b`, inverse square of b's length. gyroid: inverse period,
    /// half the thickness, factor of the field.
    std::array<double, 3> size{};
    glm::dvec3 a{0}, b{0};
    double smoothing = 0;
  };

  std::vector<Step> steps;
  carlo::Similarity place;
  bool flipped = false;
  carlo::sdf::Box box;         ///< holds the surface, in the sdf's coordinates
  Bend below{}, above{};       ///< near the surface
  double size = 0, reach = 0;  ///< half of its diagonal, and its greatest distance from the origin
};

LaneSdf lane_sdf(const carlo::Sdf& sdf);

}  // namespace renderer
