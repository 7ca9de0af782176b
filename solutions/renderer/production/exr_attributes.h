#pragma once

#include <filesystem>
#include <map>
#include <string>

namespace carlo {

/// The header of an EXR file written by us (image/exr.h).
struct ExrAttributes {
  int width = 0, height = 0;
  std::map<std::string, std::string> values = {};  ///< attributes that begin with "carlo:"
};

/// Throws Error, which names the file, if it is no EXR or ends within the header.
ExrAttributes read_exr_attributes(const std::filesystem::path& path);

}  // namespace carlo
