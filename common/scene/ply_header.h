#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace carlo {

enum class PlyType { i8, u8, i16, u16, i32, u32, f32, f64 };

struct PlyProperty {
  std::string name;
  PlyType type = PlyType::f32;
  bool list = false;
  PlyType count_type = PlyType::u8;  ///< of a list's length
};

struct PlyElement {
  std::string name;
  std::size_t count = 0;
  std::vector<PlyProperty> properties;
};

enum class PlyFormat { ascii, little_endian, big_endian };

struct PlyHeader {
  PlyFormat format = PlyFormat::ascii;
  std::vector<PlyElement> elements;
  std::size_t size = 0, lines = 0;  ///< up to and including the line end_header
  char end_of_line = '\n';          ///< the last byte of a line: \r as old Macintoshes wrote them
};

/// Reads the header of a PLY file. Throws Error "FILE:LINE: what is wrong"; `name` is the file's.
PlyHeader parse_ply_header(std::string_view text, const std::string& name);

bool is_integer(PlyType type);

}  // namespace carlo
