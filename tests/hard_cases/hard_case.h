#pragma once

#include <string>
#include <vector>

namespace hard_cases {

/// A place where the obvious code fails: its result, our result, and the bound that ours must keep.
struct HardCase {
  int number = 0;
  std::string name;
  std::string naive, ours, bound;
  bool holds = false;
};

// Each family runs its cases.
std::vector<HardCase> number_cases();    ///< conversions, sums, generators, tables
std::vector<HardCase> light_cases();     ///< solid angles and light samples
std::vector<HardCase> geometry_cases();  ///< intersections, ray origins, frames
std::vector<HardCase> lobe_cases();      ///< BRDFs and directions
std::vector<HardCase> path_cases();      ///< whole renders

}  // namespace hard_cases
