#pragma once

#include <string>
#include <vector>

namespace hard_cases {

/// One place where the obvious code fails: what that gives, what ours gives, and the bound that
/// ours has to keep.
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
