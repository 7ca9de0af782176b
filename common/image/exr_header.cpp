#include "image/exr_header.h"

#include "support/error.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <fstream>
#include <map>
#include <string>
#include <system_error>

namespace carlo {
namespace {

constexpr std::uint32_t magic = 20000630, of_many_parts = 0x1000;

/// Little-endian, like all of OpenEXR.
std::uint32_t read_word(std::istream& in) {
  std::uint32_t word = 0;
  for (int shift = 0; shift < 32; shift += 8)
    word |= static_cast<std::uint32_t>(in.get() & 0xFF) << shift;
  return word;
}

/// The sizes of values by type; OpenEXR reads this many bytes whatever the file says, and takes
/// what follows for the next attribute.
const std::map<std::string, std::uint32_t> sizes = {
    {"box2f", 16},      {"box2i", 16},   {"chromaticities", 32},
    {"compression", 1}, {"double", 8},   {"envmap", 1},
    {"float", 4},       {"int", 4},      {"keycode", 28},
    {"lineOrder", 1},   {"m33d", 72},    {"m33f", 36},
    {"m44d", 128},      {"m44f", 64},    {"rational", 8},
    {"tiledesc", 9},    {"timecode", 8}, {"v2d", 16},
    {"v2f", 8},         {"v2i", 8},      {"v3d", 24},
    {"v3f", 12},        {"v3i", 12},     {"deepImageState", 1}};

/// The memory that OpenEXR allocates for one block of lines, derived from three of the attributes;
/// for a tiled part an upper bound.
struct Block {
  std::uintmax_t width = 0, bytes_of_pixel = 0, lines = 1;

  std::uintmax_t bytes_of_column() const { return bytes_of_pixel * lines; }
};

/// OpenEXR allocates as much for each of several threads.
constexpr std::uintmax_t most_block_bytes = std::uintmax_t{128} << 20;

/// The number of lines packed together, by compression method.
std::uintmax_t lines_of(int compression) {
  constexpr std::array<std::uintmax_t, 10> lines{1, 1, 1, 16, 32, 16, 32, 32, 32, 256};
  const auto place = static_cast<std::size_t>(compression);
  return place < lines.size() ? lines[place] : 1;
}

/// Reads left and right ends, both inclusive, as signed words; top and bottom follow.
std::uintmax_t width_of_window(std::istream& in) {
  const auto left = static_cast<std::int32_t>(read_word(in));
  (void)read_word(in);
  const auto right = static_cast<std::int32_t>(read_word(in));
  return right < left ? 0 : static_cast<std::uintmax_t>(std::int64_t{right} - left + 1);
}

/// The size in bytes of a list of channels (name, 0, type, 12 more), which ends with an empty name.
/// Adds the channels' bytes per pixel: two for halves (type 1), four for others.
std::uintmax_t size_of_channels(std::istream& in, std::uintmax_t& bytes_of_pixel) {
  std::uintmax_t size = 1;
  for (std::string name; std::getline(in, name, '\0') && !name.empty();) {
    size += name.size() + 1 + 16;
    bytes_of_pixel += read_word(in) == 1 ? 2 : 4;
    in.seekg(12, std::ios::cur);
  }
  return size;
}

/// The size in bytes of a preview: width, height, and four bytes a pixel.
std::uintmax_t size_of_preview(std::istream& in) {
  const std::uintmax_t width = read_word(in), height = read_word(in);
  return 8 + 4 * width * height;
}

/// The number of bytes from which the value that starts here will be read; the attribute claims
/// `claimed`. Records its information on blocks.
std::uintmax_t size_of_value(std::istream& in, const std::string& name, const std::string& type,
                             std::uint32_t claimed, Block& block) {
  if (type == "chlist") return size_of_channels(in, block.bytes_of_pixel);
  if (type == "preview") return size_of_preview(in);
  if (type == "compression") block.lines = lines_of(in.get());
  if (name == "dataWindow" && type == "box2i") block.width = width_of_window(in);
  const auto known = sizes.find(type);
  return known == sizes.end() ? claimed : known->second;
}

}  // namespace

// A header is a list of attributes (name, 0, type, 0, bytes, value) that ends with an empty name; a
// multipart file has headers until an empty one.
void require_honest_header(const std::filesystem::path& path) {
  std::error_code missing;
  const std::uintmax_t size = std::filesystem::file_size(path, missing);
  std::ifstream in(path, std::ios::binary);
  if (missing || read_word(in) != magic) return;
  const bool many = (read_word(in) & of_many_parts) != 0;
  bool first_of_header = true;
  Block block;
  for (std::string name, type; std::getline(in, name, '\0');) {
    if (name.empty()) {
      if (block.bytes_of_column() > 0 && block.width > most_block_bytes / block.bytes_of_column()) {
        throw Error(
            "cannot read {}: it packs {} lines of {} pixels together, with {} bytes a pixel; "
            "expected {} MB at most",
            path.string(), block.lines, block.width, block.bytes_of_pixel, most_block_bytes >> 20);
      }
      if (!many || first_of_header) return;
      first_of_header = true;
      block = {};
      continue;
    }
    first_of_header = false;
    if (!std::getline(in, type, '\0')) return;
    const std::uint32_t bytes = read_word(in);
    if (!in) return;
    const auto begin = in.tellg();
    const auto left = size - static_cast<std::uintmax_t>(begin);
    if (bytes > left) {
      throw Error("cannot read {}: one of its attributes claims {} bytes where {} are left",
                  path.string(), bytes, left);
    }
    const std::uintmax_t needed = size_of_value(in, name, type, bytes, block);
    if (needed != bytes) {
      throw Error("cannot read {}: one of its attributes claims {} bytes, expected {}",
                  path.string(), bytes, needed);
    }
    in.seekg(begin + std::streamoff{bytes});
  }
}

}  // namespace carlo
