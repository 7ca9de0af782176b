#pragma once

#include <filesystem>
#include <map>
#include <string>

namespace carlo {

/// What the first bytes of an EXR file of ours tell (image/exr.h).
struct ExrAttributes {
  int width = 0, height = 0;
  std::map<std::string, std::string> values = {};  ///< of those that begin with "carlo:"
};

/// Throws Error, which names the file, if it is no EXR or ends within them.
ExrAttributes read_exr_attributes(const std::filesystem::path& path);

}  // namespace carlo
