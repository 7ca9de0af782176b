#pragma once

#include "scene/sdf.h"

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

}  // namespace renderer
