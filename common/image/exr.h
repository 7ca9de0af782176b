#pragma once

#include "image/image.h"

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace carlo {

/// The contents of our EXR files: 32-bit float RGB and, if known, the standard error of each pixel
/// (channels "se.R", "se.G", "se.B"), attributes such as "carlo:seed", and channels of 32-bit whole
/// numbers, row-major, such as "sums.blocks".
struct ExrFile {
  Image image;
  std::optional<Image> standard_error = {};
  std::map<std::string, std::string> attributes = {};
  std::map<std::string, std::vector<std::uint32_t>> counts = {};
  /// If not empty, the number of samples of each pixel: the channel "samples", which is not read
  /// back. Floats, since other programs read whole numbers as fractions (OpenImageIO), or shift the
  /// colours that stand beside them (three.js).
  std::vector<float> samples = {};
  std::vector<std::string> notes = {};  ///< after reading: what differs from the file
};

/// Equal contents give equal bytes: the file carries no date. Throws Error.
void write_exr(const std::filesystem::path& path, const ExrFile& file);

/// Reads the channels R, G, B (any tool's EXR will do), the standard error if present, and those
/// channels of whole numbers in `counts` that the file has. The image is the display window;
/// outside the data window it is black. Reads the first part with R, G, B, and the largest of
/// several resolutions. Converts chromaticities other than those of Rec. 709 to these
/// (primaries.h), and assumes these if there are none. Throws Error naming the path and what is
/// wrong. Source: "Technical introduction to OpenEXR".
ExrFile read_exr(const std::filesystem::path& path, const std::vector<std::string>& counts = {});

}  // namespace carlo
