#pragma once

#include "renderer/production/merge.h"

#include <string>

namespace carlo {

/// How to write the image of merged parts.
struct MergeOutput {
  std::string output;     ///< value of -o
  std::string reference;  ///< an EXR to compare with; empty: none
  bool sums = true;       ///< whether the EXR can be continued from
  bool progress = false;
};

/// Writes the image of the merged parts. Returns the report for the reader, including the files'
/// names. Throws Error.
std::string write_merged(const Merge& merge, const MergeOutput& how);

}  // namespace carlo
