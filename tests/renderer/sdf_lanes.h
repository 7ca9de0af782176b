#pragma once

#include "numeric/vec.h"

#include <cstddef>
#include <vector>

// What sdf_lanes_test.cpp has traced on each instruction set.
namespace sdf_lanes {

/// The rays o + t d, |d| = 1, t up to `far`.
struct Ray {
  carlo::Vec3 o, d;
  float far;
};

/// Rays in the order in which they come to the lanes, and where they met the sdf, in its units:
/// below 0 if nowhere.
struct Rays {
  std::vector<Ray> rays;
  std::vector<double> s;
  std::size_t gap = 0;  ///< after so many lanes one stays empty; 0: none does
};

}  // namespace sdf_lanes
