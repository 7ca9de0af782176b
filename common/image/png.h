#pragma once

#include "image/image.h"

#include <filesystem>

namespace carlo {

/// Writes 8-bit sRGB: linear values times 2^stops, clipped to [0, 1]. Throws Error.
void write_png(const std::filesystem::path& path, const Image& image, float stops = 0);

}  // namespace carlo
