#pragma once

#include <OpenImageIO/imageio.h>

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>

namespace carlo {

/// Maps the pixels of an OpenEXR file (its data window) to its image (its display window).
class ExrWindow {
 public:
  /// Throws Error naming the path if the display window is empty or has too many pixels.
  ExrWindow(const OIIO::ImageSpec& spec, const std::filesystem::path& path);

  /// Size of the image.
  int width() const { return width_; }
  int height() const { return height_; }

  /// The index of the data pixel at the image's pixel x, y; nothing if there is none.
  std::optional<std::size_t> find(int x, int y) const;

  /// Describes which part of the image is black for lack of data, and which data lies outside the
  /// image.
  std::optional<std::string> note() const;

 private:
  int width_, height_;
  int data_width_, data_height_;
  std::ptrdiff_t left_, top_;  ///< of the data, in the image
};

}  // namespace carlo
