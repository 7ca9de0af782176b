#pragma once

#include "grader/grade/clean_tree.h"

#include <filesystem>
#include <string>

namespace carlo::grader {

/// Has g++ read the header that all files of a lab share, as "path_tracer.h" of lab 08, once for a
/// clean tree, where the lab has so many files that this pays. Who comes meanwhile, or where it
/// fails, goes on without.
void precompile(const LabTools& tools);

/// The header's name, for -include, where it was read ahead and that changes nothing for `text`: it
/// includes the header itself, and defines nothing before that. Else empty.
std::string header_ahead(const LabTools& tools, const std::string& text);

}  // namespace carlo::grader
