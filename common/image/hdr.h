#pragma once

#include "image/image.h"

#include <filesystem>

namespace carlo {

/// Reads a Radiance picture (.hdr): 32-bit RGBE, plain or in runs, with the top row first; values
/// are divided by the header's EXPOSURE, if it has one. Throws Error naming the path and what is
/// wrong.
/// Source: Ward, "Real pixels", Graphics Gems II, 1991.
Image read_hdr(const std::filesystem::path& path);

}  // namespace carlo
