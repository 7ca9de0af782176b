#pragma once

#include "image/image.h"

#include <filesystem>
#include <map>
#include <optional>
#include <string>

namespace carlo {

/// What an EXR file of ours holds: 32-bit float RGB, and beside it, if known, the standard error of
/// each pixel (channels "se.R", "se.G", "se.B") and attributes such as "carlo:seed".
struct ExrFile {
  Image image;
  std::optional<Image> standard_error;
  std::map<std::string, std::string> attributes;
};

/// Equal contents give equal bytes: the file carries no date. Throws Error.
void write_exr(const std::filesystem::path& path, const ExrFile& file);

/// Reads the channels R, G, B (any other tool's EXR will do), and the standard error if it is
/// there. Throws Error naming the path and what is wrong.
ExrFile read_exr(const std::filesystem::path& path);

}  // namespace carlo
