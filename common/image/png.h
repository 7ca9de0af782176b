#pragma once

#include "image/image.h"

#include <filesystem>
#include <string>

namespace carlo {

/// The bytes of a PNG file, 8-bit sRGB: linear values times 2^stops, clipped to [0, 1]; NaN becomes
/// 0. Throws Error if out of memory.
std::string png(const Image& image, float stops = 0);

/// Writes 8-bit sRGB: linear values times 2^stops, clipped to [0, 1]. Throws Error.
void write_png(const std::filesystem::path& path, const Image& image, float stops = 0);

}  // namespace carlo
