#pragma once

#include <filesystem>

namespace bench {

/// This program's file.
std::filesystem::path this_program();

}  // namespace bench
