#pragma once

#include "scene/scene.h"

#include <cstdint>
#include <span>
#include <vector>

namespace carlo {

/// The parallelograms of a scene by the planes that they lie in: of two the same when the corners
/// of each lie in the other's, but for four roundings to float of the corner's coordinates and of
/// the plane's distance from the origin.
struct Planes {
  struct Entry {
    std::uint32_t first = 0;  ///< the first parallelogram of the plane: its own number if it is
    double gap = 0;           ///< how far the two are from one plane, at their corners
  };
  std::vector<Entry> of;  ///< each parallelogram's
};

Planes find_planes(std::span<const Parallelogram> parallelograms);

}  // namespace carlo
