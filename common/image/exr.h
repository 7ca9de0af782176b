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
/// numbers, row-major, such as "samples".
struct ExrFile {
  Image image;
  std::optional<Image> standard_error = {};
  std::map<std::string, std::string> attributes = {};
  std::map<std::string, std::vector<std::uint32_t>> counts = {};
  /// The lines [first, end) alone are in the file, all others are 0.
  struct Lines {
    int first = 0, end = 0;
  };
  std::optional<Lines> lines = {};
  std::vector<std::string> notes = {};  ///< of what was read: what is not as it stands in the file
};

/// Equal contents give equal bytes: the file carries no date. Throws Error.
void write_exr(const std::filesystem::path& path, const ExrFile& file);

/// Reads the channels R, G, B (any other tool's EXR will do), the standard error if it is there,
/// and those channels of whole numbers whose names are in `counts` and that the file has (one of
/// channels of 32 bits alone, as we write them). The image is the display window; outside of the
/// data window it is black. Of several parts it is the first one with R, G, B, of several
/// resolutions the largest. Chromaticities other than those of Rec. 709 are taken to these
/// (primaries.h), and without any they are these. Throws Error naming the path and what is wrong.
/// Source: "Technical introduction to OpenEXR".
ExrFile read_exr(const std::filesystem::path& path, const std::vector<std::string>& counts = {});

}  // namespace carlo
