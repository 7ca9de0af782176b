#pragma once

#include <filesystem>

namespace carlo {

/// Returns the absolute path of the tree that this program was built from. Only one small file
/// knows it, so that other compilations do not contain the path and trees elsewhere share them in
/// the compiler cache.
std::filesystem::path source_folder();

}  // namespace carlo
