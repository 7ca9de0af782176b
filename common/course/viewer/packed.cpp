#include "course/viewer/packed.h"

#include "image/png.h"
#include "support/error.h"

#include <zlib.h>

#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace carlo {
namespace {

/// Returns the upper 24 bits of the nearest float whose other bits are 0.
std::uint32_t upper_bits(float value) {
  if (std::isnan(value)) return 0x7FC000;
  const auto bits = std::bit_cast<std::uint32_t>(value);
  if (std::isinf(value)) return bits >> 8;
  const std::uint32_t nearest = (bits + 0x80) >> 8;
  // The largest finite floats would become infinite.
  return (nearest & 0x7FFFFF) == 0x7F8000 ? nearest - 1 : nearest;
}

std::string deflated(const std::vector<Bytef>& bytes) {
  uLongf size = compressBound(static_cast<uLong>(bytes.size()));
  std::string result(size, '\0');
  // zlib's bytes are unsigned.
  auto* const room = reinterpret_cast<Bytef*>(result.data());
  if (compress2(room, &size, bytes.data(), static_cast<uLong>(bytes.size()), 6) != Z_OK) {
    throw Error("cannot compress an image for the page: out of memory");
  }
  result.resize(size);
  return result;
}

}  // namespace

std::string base64(std::string_view bytes) {
  constexpr char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t word = 0;
    for (std::size_t k = i; k < i + 3; ++k)
      word = word << 8 | (k < bytes.size() ? static_cast<unsigned char>(bytes[k]) : 0u);
    for (std::size_t k = 0; k < 4; ++k)
      text += i + k <= bytes.size() ? digits[word >> (18 - 6 * k) & 63] : '=';
  }
  return text;
}

std::string packed(std::span<const float> values) {
  const std::size_t n = values.size();
  std::vector<Bytef> planes(3 * n);
  for (std::size_t i = 0; i < n; ++i) {
    const std::uint32_t bits = upper_bits(values[i]);
    planes[i] = static_cast<Bytef>(bits >> 16);
    planes[i + n] = static_cast<Bytef>(bits >> 8 & 0xFF);
    planes[i + 2 * n] = static_cast<Bytef>(bits & 0xFF);
  }
  return base64(deflated(planes));
}

std::string packed(const Image& image) {
  std::vector<float> values;
  values.reserve(3 * image.pixels.size());
  for (int c = 0; c < 3; ++c) {
    for (const Rgb& pixel : image.pixels)
      values.push_back(pixel[c]);
  }
  return packed(values);
}

std::string picture_url(const Image& image, double white) {
  return "data:image/png;base64," + base64(png(image, static_cast<float>(-std::log2(white))));
}

}  // namespace carlo
