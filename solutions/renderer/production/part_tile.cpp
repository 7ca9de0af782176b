#include "renderer/production/part_tile.h"

#include "render/driver.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <limits>

namespace carlo {
namespace {

static_assert(std::endian::native == std::endian::little, "parts are little-endian");

constexpr std::size_t numbers_count = 4;  ///< of a sum: its position and three digits
constexpr std::size_t plane_head = 9, word_bytes = 8;
constexpr std::size_t most_pixels_of_tile = std::size_t{driver_tile_size} * driver_tile_size;

/// The numbers of one sum, of each pixel.
using Planes = std::array<std::array<std::int64_t, most_pixels_of_tile>, numbers_count>;

ExactSum& sum_of(PixelSums& pixel, std::size_t which) {
  return which < 3 ? pixel.sum[which] : pixel.squares[which - 3];
}

const ExactSum& sum_of(const PixelSums& pixel, std::size_t which) {
  return which < 3 ? pixel.sum[which] : pixel.squares[which - 3];
}

void split(const ExactSum& sum, Planes& planes, std::size_t i) {
  const auto words = sum.words();
  planes[0][i] = static_cast<std::int32_t>(words[0]);
  for (std::size_t digit = 1; digit < numbers_count; ++digit) {
    planes[digit][i] =
        static_cast<std::int64_t>(std::uint64_t{words[2 * digit]} << 32 | words[2 * digit - 1]);
  }
}

ExactSum joined(const Planes& planes, std::size_t i) {
  std::array<std::uint32_t, ExactSum::words_count> words{static_cast<std::uint32_t>(planes[0][i])};
  for (std::size_t digit = 1; digit < numbers_count; ++digit) {
    words[2 * digit - 1] = static_cast<std::uint32_t>(planes[digit][i]);
    words[2 * digit] =
        static_cast<std::uint32_t>(static_cast<std::uint64_t>(planes[digit][i]) >> 32);
  }
  return ExactSum::from_words(words);
}

void append_plane(std::vector<unsigned char>& bytes, std::span<const std::int64_t> numbers) {
  const auto [least, most] = std::minmax_element(numbers.begin(), numbers.end());
  const auto base = static_cast<std::uint64_t>(*least);
  const std::size_t width =
      (static_cast<std::size_t>(std::bit_width(static_cast<std::uint64_t>(*most) - base)) + 7) / 8;
  const std::size_t begin = bytes.size(), size = plane_head + width * numbers.size();
  bytes.resize(begin + size + word_bytes);
  std::memcpy(&bytes[begin], &base, sizeof base);
  bytes[begin + sizeof base] = static_cast<unsigned char>(width);
  // Writes whole words: each overwrites the superfluous bytes of the previous one.
  unsigned char* at = &bytes[begin + plane_head];
  for (const std::int64_t number : numbers) {
    const std::uint64_t above = static_cast<std::uint64_t>(number) - base;
    std::memcpy(at, &above, sizeof above);
    at += width;
  }
  bytes.resize(begin + size);
}

/// Reads a plane off the front of `bytes`; false if it is malformed.
bool read_plane(std::span<const unsigned char>& bytes, std::span<std::int64_t> numbers) {
  if (bytes.size() < plane_head) return false;
  std::uint64_t base;
  std::memcpy(&base, bytes.data(), sizeof base);
  const std::size_t width = bytes[sizeof base];
  if (width > word_bytes || bytes.size() - plane_head < width * numbers.size()) return false;
  const std::uint64_t mask =
      width == 0 ? 0 : std::numeric_limits<std::uint64_t>::max() >> (64 - 8 * width);
  bytes = bytes.subspan(plane_head);
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    std::uint64_t above = 0;
    const std::size_t at = i * width;
    if (at + word_bytes <= bytes.size()) {
      std::memcpy(&above, bytes.data() + at, word_bytes);
    } else if (at < bytes.size()) {
      std::memcpy(&above, bytes.data() + at, bytes.size() - at);
    }
    numbers[i] = static_cast<std::int64_t>(base + (above & mask));
  }
  bytes = bytes.subspan(width * numbers.size());
  return true;
}

}  // namespace

void append_tile(std::vector<unsigned char>& bytes, std::span<const PixelSums> pixels) {
  Planes planes;
  for (std::size_t which = 0; which < 6; ++which) {
    for (std::size_t i = 0; i < pixels.size(); ++i)
      split(sum_of(pixels[i], which), planes, i);
    for (const auto& plane : planes)
      append_plane(bytes, std::span(plane).first(pixels.size()));
  }
}

bool add_tile(std::span<const unsigned char> bytes, std::span<PixelSums> pixels) {
  Planes planes;
  for (std::size_t which = 0; which < 6; ++which) {
    for (auto& plane : planes)
      if (!read_plane(bytes, std::span(plane).first(pixels.size()))) return false;
    for (std::size_t i = 0; i < pixels.size(); ++i)
      sum_of(pixels[i], which).add(joined(planes, i));
  }
  return bytes.empty();
}

std::size_t most_tile_bytes(std::size_t pixels) {
  return 6 * numbers_count * (plane_head + word_bytes * pixels);
}

}  // namespace carlo
