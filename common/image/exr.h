#pragma once

#include "image/image.h"

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace carlo {

/// What an EXR file of ours holds: 32-bit float RGB, and beside it, if known, the standard error of
/// each pixel (channels "se.R", "se.G", "se.B"), attributes such as "carlo:seed", and channels of
/// 32-bit whole numbers, row-major, such as "samples".
struct ExrFile {
  Image image;
  std::optional<Image> standard_error = {};
  std::map<std::string, std::string> attributes = {};
  std::map<std::string, std::vector<std::uint32_t>> counts = {};
};

/// Equal contents give equal bytes: the file carries no date. Throws Error.
void write_exr(const std::filesystem::path& path, const ExrFile& file);

/// Reads the channels R, G, B (any other tool's EXR will do), the standard error if it is there,
/// and those channels of whole numbers whose names are in `counts` and that the file has. Throws
/// Error naming the path and what is wrong.
ExrFile read_exr(const std::filesystem::path& path, const std::vector<std::string>& counts = {});

}  // namespace carlo
