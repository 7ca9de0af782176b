#pragma once

#include "scene/sdf.h"

namespace renderer {

/// A bound on the second derivative of a signed distance function F along lines (per unit of its
/// coordinates), and as far as which values of F it holds.
struct Bend {
  double most;
  double reach;
};

/// F'' >= -result along every line wherever F < reach, reach > 0; infinity where there is no bound.
/// Outside of what is convex it is 0; a crease that points outwards does not count against it, as
/// F' only rises there.
double bend_below(const carlo::Sdf& sdf, double reach);
/// F'' <= result wherever F > -reach.
double bend_above(const carlo::Sdf& sdf, double reach);

/// The bound whose reach lets sphere tracing take the longest steps from the surface of an sdf of
/// this size; a reach of 0 where there is none.
Bend bend_below_near(const carlo::Sdf& sdf, double size);
Bend bend_above_near(const carlo::Sdf& sdf, double size);

}  // namespace renderer
