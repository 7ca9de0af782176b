#pragma once

#include <filesystem>

namespace carlo {

/// The folder of the tree that this program was built from, absolute. Known to one small file
/// alone: what others compile does not tell where the tree lies, and trees at other places share it
/// in the compiler's cache.
std::filesystem::path source_folder();

}  // namespace carlo
