#pragma once

#include "image/image.h"

#include <filesystem>
#include <string>
#include <vector>

namespace carlo {

/// A Radiance picture in linear Rec. 709, and the contents of the file that are not used.
struct HdrFile {
  Image image;
  std::vector<std::string> notes = {};
};

/// Reads a Radiance picture (.hdr): 32-bit RGBE, plain or run-length encoded, with the top row
/// first. Values are divided by the header's EXPOSURE and COLORCORR. PRIMARIES other than those of
/// Rec. 709 are converted to these (primaries.h); without any, these are assumed. Throws Error
/// naming the path and what is wrong. Source: Ward, "Real pixels", Graphics Gems II, 1991;
/// "Radiance file formats", pictures.
HdrFile read_hdr(const std::filesystem::path& path);

}  // namespace carlo
