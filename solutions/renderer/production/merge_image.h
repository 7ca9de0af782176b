#pragma once

#include "renderer/production/merge.h"

#include <string>

namespace carlo {

/// How parts become an image.
struct MergeOutput {
  std::string output;     ///< what -o said
  std::string reference;  ///< an EXR to compare with; empty: none
  bool sums = true;       ///< whether the EXR can be gone on with
  bool progress = false;
};

/// Writes the image of what a merge has. Returns the report for people, files' names included.
/// Throws Error.
std::string write_merged(const Merge& merge, const MergeOutput& how);

}  // namespace carlo
