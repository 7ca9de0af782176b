#include "renderer/production/exr_attributes.h"

#include "image/image.h"
#include "support/error.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <fstream>
#include <string_view>
#include <system_error>

namespace carlo {
namespace {

constexpr std::uint32_t magic = 20000630;
constexpr std::string_view our_prefix = "carlo:";

/// Reads a little-endian word, as everywhere in OpenEXR.
std::uint32_t read_word(std::istream& in) {
  std::uint32_t word = 0;
  for (int shift = 0; shift < 32; shift += 8)
    word |= static_cast<std::uint32_t>(in.get() & 0xFF) << shift;
  return word;
}

/// Reads left, top, right and bottom, all inclusive.
void read_window(std::istream& in, ExrAttributes& attributes) {
  std::array<std::int64_t, 4> ends{};
  for (std::int64_t& end : ends)
    end = static_cast<std::int32_t>(read_word(in));
  attributes.width =
      static_cast<int>(std::clamp<std::int64_t>(ends[2] - ends[0] + 1, 0, most_pixels));
  attributes.height =
      static_cast<int>(std::clamp<std::int64_t>(ends[3] - ends[1] + 1, 0, most_pixels));
}

}  // namespace

// A header is a list of attributes (name, 0, type, 0, bytes, value) that ends with an empty name.
ExrAttributes read_exr_attributes(const std::filesystem::path& path) {
  std::error_code none;
  const std::uintmax_t size = std::filesystem::file_size(path, none);
  std::ifstream in(path, std::ios::binary);
  if (none || !in) throw Error("cannot read {}: there is no such file", path.string());
  if (read_word(in) != magic || !in) throw Error("cannot read {}: it is no EXR", path.string());
  (void)read_word(in);  // version and flags
  ExrAttributes attributes;
  for (std::string name, type; std::getline(in, name, '\0') && std::getline(in, type, '\0');) {
    const std::uint32_t bytes = read_word(in);
    const auto begin = in.tellg();
    if (!in || bytes > size - static_cast<std::uintmax_t>(begin)) break;
    if (name.starts_with(our_prefix) && type == "string") {
      std::string value(bytes, '\0');
      in.read(value.data(), static_cast<std::streamsize>(value.size()));
      attributes.values[name.substr(our_prefix.size())] = value;
    }
    if (name == "displayWindow" && type == "box2i") read_window(in, attributes);
    in.seekg(begin + std::streamoff{bytes});
    if (in.peek() == '\0') return attributes;
  }
  throw Error("cannot read {}: it is cut short", path.string());
}

}  // namespace carlo
