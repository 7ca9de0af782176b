#pragma once

#include "grader/grade/clean_tree.h"

#include <filesystem>
#include <string>

namespace carlo::grader {

/// Precompiles, with g++, the header that all files of a lab share, e.g. "path_tracer.h" of lab 8,
/// once per clean tree, if the lab has so many files that this pays. Processes that arrive
/// meanwhile, or after a failure, compile without it.
void precompile(const LabTools& tools);

/// Returns the header's name, for -include, if it was precompiled and using it changes nothing for
/// `text`: the text includes the header itself, and defines nothing before that. Otherwise empty.
std::string header_ahead(const LabTools& tools, const std::string& text);

}  // namespace carlo::grader
