#pragma once

#include "numeric/vec.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace carlo {

/// The most pixels of any image, as a film or in a file: 8K UHD, 7680 x 4320, fits.
constexpr std::int64_t most_pixels = std::int64_t{1} << 25;

/// Linear RGB, row-major, the top row first.
struct Image {
  int width = 0, height = 0;
  std::vector<Rgb> pixels;

  Image() = default;
  Image(int w, int h)
      : width(w), height(h), pixels(static_cast<std::size_t>(w) * static_cast<std::size_t>(h)) {}

  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
           static_cast<std::size_t>(x);
  }
  Rgb& at(int x, int y) { return pixels[index(x, y)]; }
  const Rgb& at(int x, int y) const { return pixels[index(x, y)]; }
};

/// Relative luminance of linear sRGB (ITU-R BT.709).
inline double luminance(const std::array<double, 3>& c) {
  return 0.2126 * c[0] + 0.7152 * c[1] + 0.0722 * c[2];
}

}  // namespace carlo
