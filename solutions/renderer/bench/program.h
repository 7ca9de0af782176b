#pragma once

#include <filesystem>

namespace bench {

/// The path of this program's file.
std::filesystem::path this_program();

}  // namespace bench
