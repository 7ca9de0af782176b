#pragma once

#include "scene/scene.h"

#include <cstdint>
#include <span>
#include <vector>

namespace carlo {

/// The parallelograms of a scene by the planes that they lie in, of two the same when rounding to
/// float could not tell them apart: at the corners of both, for theirs and the plane's coordinates.
struct Planes {
  struct Entry {
    std::uint32_t first = 0;  ///< the first parallelogram of the plane: its own number if it is
    double gap = 0;           ///< how far the two are from one plane, at their corners
  };
  std::vector<Entry> of;  ///< each parallelogram's
};

Planes find_planes(std::span<const Parallelogram> parallelograms);

}  // namespace carlo
