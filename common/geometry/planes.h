#pragma once

#include "scene/scene.h"

#include <cstdint>
#include <span>
#include <vector>

namespace carlo {

/// A scene's parallelograms, grouped by plane. Two share a plane if the corners of each lie in the
/// other's plane, up to four float roundings of the corner's coordinates and of the plane's
/// distance from the origin.
struct Planes {
  struct Entry {
    std::uint32_t first = 0;  ///< the first parallelogram of the plane: its own number if that is
                              ///< itself
    double gap = 0;           ///< the largest distance of the two from a common plane, at their
                              ///< corners
  };
  std::vector<Entry> of;  ///< one entry per parallelogram
};

Planes find_planes(std::span<const Parallelogram> parallelograms);

}  // namespace carlo
