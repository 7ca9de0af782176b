#include "image/png.h"

#include "support/atomic_file.h"
#include "support/error.h"

#include <stb/stb_image_write.h>

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

namespace carlo {
namespace {

/// The sRGB transfer function (IEC 61966-2-1) to 8 bits; NaN becomes 0.
std::uint8_t encode(float linear) {
  if (!(linear > 0)) return 0;
  if (linear >= 1) return 255;
  const float s =
      linear <= 0.0031308f ? 12.92f * linear : 1.055f * std::pow(linear, 1 / 2.4f) - 0.055f;
  return static_cast<std::uint8_t>(std::lround(255 * s));
}

}  // namespace

std::string png(const Image& image, float stops) {
  const float gain = std::exp2(stops);
  std::vector<std::uint8_t> bytes;
  bytes.reserve(image.pixels.size() * 3);
  for (const Rgb& pixel : image.pixels) {
    for (int c = 0; c < 3; ++c)
      bytes.push_back(encode(gain * pixel[c]));
  }
  std::string png;
  const auto append = [](void* context, void* data, int size) {
    static_cast<std::string*>(context)->append(static_cast<const char*>(data),
                                               static_cast<std::size_t>(size));
  };
  if (stbi_write_png_to_func(append, &png, image.width, image.height, 3, bytes.data(),
                             3 * image.width) == 0) {
    throw Error("cannot make a PNG of {} x {} pixels: out of memory", image.width, image.height);
  }
  return png;
}

void write_png(const std::filesystem::path& path, const Image& image, float stops) {
  // Encodes to memory first: stb's own file output does not notice a full disk.
  write_file(path, png(image, stops));
}

}  // namespace carlo
