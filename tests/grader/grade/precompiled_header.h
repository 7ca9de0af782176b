#pragma once

#include "grader/grade/clean_tree.h"

#include <filesystem>

namespace carlo::grader {

/// The header of a lab's own folder that all its stubs include, as "path_tracer.h" of lab 08; empty
/// where there is none. A path in the clean tree.
std::filesystem::path common_header(const LabTools& tools);

/// What g++ takes in the place of a header: the header, read once for all files (0.2 s in the place
/// of 1.2 s for a file of lab 09). Empty where it was not made.
std::filesystem::path precompiled(const std::filesystem::path& header);

/// Makes it for a lab of many files, once in a clean tree: who comes meanwhile goes on without it,
/// and so do all where a stub does not compile with it.
void precompile(const LabTools& tools);

}  // namespace carlo::grader
