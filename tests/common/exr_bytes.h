#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <string>
#include <vector>

// OpenEXR files of one part, uncompressed, with features that our writer never writes.

namespace common_test {

struct Box {
  int left, top, right, bottom;  ///< the last two inclusive
};

inline std::string little(std::uint64_t value, int bytes) {
  std::string out;
  for (int i = 0; i < bytes; ++i)
    out += static_cast<char>(value >> (8 * i));
  return out;
}

inline std::string little(float value) {
  return little(std::bit_cast<std::uint32_t>(value), 4);
}

inline std::string exr_attribute(const std::string& name, const std::string& type,
                                 const std::string& value) {
  return name + '\0' + type + '\0' + little(value.size(), 4) + value;
}

inline std::string exr_box(const std::string& name, Box b) {
  std::string value;
  for (const int x : {b.left, b.top, b.right, b.bottom})
    value += little(static_cast<std::uint32_t>(x), 4);
  return exr_attribute(name, "box2i", value);
}

inline std::string exr_floats(const std::string& name, const std::string& type,
                              const std::vector<float>& values) {
  std::string value;
  for (const float x : values)
    value += little(x);
  return exr_attribute(name, type, value);
}

/// OpenEXR's codes for the type of a channel's numbers.
enum class ExrType { whole = 0, half = 1, single = 2 };

/// `pixels`: R, G, B of each pixel of the data window, as the words that stand in the file.
/// `names`: of the channels with B, G and R, in the alphabet's order.
inline std::string exr_bytes_of(ExrType type, Box display, Box data,
                                const std::vector<std::array<std::uint32_t, 3>>& pixels,
                                const std::string& more = "", const std::string& names = "BGR") {
  std::string channels;
  for (const char name : names) {
    channels += std::string{name, '\0'} + little(static_cast<std::uint32_t>(type), 4) +
                little(0, 4) + little(1, 4) + little(1, 4);
  }
  std::string out = little(20000630, 4) + little(2, 4) +
                    exr_attribute("channels", "chlist", channels + '\0') +
                    exr_attribute("compression", "compression", std::string(1, '\0')) +
                    exr_box("dataWindow", data) + exr_box("displayWindow", display) +
                    exr_attribute("lineOrder", "lineOrder", std::string(1, '\0')) +
                    exr_floats("pixelAspectRatio", "float", {1}) +
                    exr_floats("screenWindowCenter", "v2f", {0, 0}) +
                    exr_floats("screenWindowWidth", "float", {1}) + more + '\0';
  const auto width = static_cast<std::size_t>(data.right - data.left + 1);
  const auto height = static_cast<std::size_t>(data.bottom - data.top + 1);
  const int bytes_of_number = type == ExrType::half ? 2 : 4;
  const std::size_t bytes_of_line = 3 * static_cast<std::size_t>(bytes_of_number) * width;
  const std::size_t lines = out.size() + 8 * height;
  for (std::size_t y = 0; y < height; ++y)
    out += little(lines + y * (8 + bytes_of_line), 8);
  for (std::size_t y = 0; y < height; ++y) {
    out += little(static_cast<std::uint32_t>(data.top) + y, 4) + little(bytes_of_line, 4);
    for (const std::size_t channel : {2u, 1u, 0u}) {
      for (std::size_t x = 0; x < width; ++x)
        out += little(pixels.at(y * width + x).at(channel), bytes_of_number);
    }
  }
  return out;
}

/// The same with floats.
inline std::string exr_bytes(Box display, Box data, const std::vector<std::array<float, 3>>& pixels,
                             const std::string& more = "") {
  std::vector<std::array<std::uint32_t, 3>> words;
  for (const auto& [r, g, b] : pixels) {
    words.push_back({std::bit_cast<std::uint32_t>(r), std::bit_cast<std::uint32_t>(g),
                     std::bit_cast<std::uint32_t>(b)});
  }
  return exr_bytes_of(ExrType::single, display, data, words, more);
}

}  // namespace common_test
