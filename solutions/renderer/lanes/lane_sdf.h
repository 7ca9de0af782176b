#pragma once

#include "renderer/lanes/sdf_bends.h"
#include "scene/sdf.h"

#include <array>
#include <vector>

namespace renderer {

/// A signed distance function as the vector kernels read it: carlo::Sdf's steps, their kinds as
/// numbers, what does not depend on the point worked out. All in double, as in the SphereTracer.
struct LaneSdf {
  enum class Part { ball, torus, rounded_box, capsule, gyroid, unite, intersect, subtract };

  /// The last three combine, and have a smoothing alone.
  struct Step {
    Part part;
    /// A form's own coordinates are turn (p - origin) of the sdf's, and its distance counts `scale`
    /// times.
    glm::dmat3 turn{1};
    glm::dvec3 origin{0};
    double scale = 1;
    /// ball: radius. torus: major, minor. rounded_box: radius; `a` the half sides of the box
    /// within. capsule: radius; from `a` along `b`, inverse square of b's length. gyroid:
    /// inverse period, half of the thickness, what the field is multiplied by.
    std::array<double, 3> size{};
    glm::dvec3 a{0}, b{0};
    double smoothing = 0;
  };

  std::vector<Step> steps;
  carlo::Similarity place;
  bool flipped = false;
  carlo::sdf::Box box;         ///< holds the surface, in the sdf's coordinates
  Bend below{}, above{};       ///< near the surface
  double size = 0, reach = 0;  ///< half of its diagonal, and how far it comes from the origin
};

LaneSdf lane_sdf(const carlo::Sdf& sdf);

}  // namespace renderer
