#pragma once

#include "numeric/vec.h"

#include <cstddef>
#include <vector>

// Traces for sdf_lanes_test.cpp, computed on each instruction set.
namespace sdf_lanes {

/// The rays o + t d, |d| = 1, t up to `far`.
struct Ray {
  carlo::Vec3 o, d;
  float far;
};

/// Rays in the order in which they get lanes, and where they met the sdf, in its units: below 0 if
/// nowhere.
struct Rays {
  std::vector<Ray> rays;
  std::vector<double> s;
  std::size_t gap = 0;  ///< after this many lanes one stays empty; 0: none does
};

}  // namespace sdf_lanes
