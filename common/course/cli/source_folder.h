#pragma once

#include <filesystem>

namespace carlo {

/// Returns the absolute path of the tree that this program was built from. Only one small file
/// contains the path, so that trees in other folders share all other compilations in the compiler
/// cache.
std::filesystem::path source_folder();

}  // namespace carlo
