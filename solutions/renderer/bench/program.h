#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace bench {

/// What a program prints on stdout. Throws Error if it cannot be started or fails.
std::string output_of(const std::filesystem::path& program,
                      const std::vector<std::string>& arguments);

/// This program's file.
std::filesystem::path this_program();

}  // namespace bench
