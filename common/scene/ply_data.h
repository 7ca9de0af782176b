#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
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

/// The values after the header of a PLY file, one after the other, text or binary. Errors name the
/// file, the line if there are lines, and the property.
class PlyData {
 public:
  /// `text`: the whole file, header and all. The other two must outlive this.
  PlyData(std::string_view text, const PlyHeader& header, const std::string& name);

  /// The next value, which has this type: in text it must be a finite number, in binary anything
  /// goes.
  double number(const PlyProperty& property, PlyType type);
  /// The same for a property that may be nan or infinite.
  double any_number(const PlyProperty& property);
  /// The same as a count or an index.
  std::uint32_t whole(const PlyProperty& property, PlyType type);
  /// The same as an index; nothing for -1.
  std::optional<std::uint32_t> whole_or_end(const PlyProperty& property);
  /// Skips a property's values, whatever they are.
  void skip(const PlyProperty& property);

  /// Checks what follows the last value: anything more than the end of a line is an error. Returns
  /// a note, if any.
  std::optional<std::string> finish();

  bool has_lines() const { return !binary_; }
  /// The line of the last value.
  std::size_t line() const { return line_; }

  [[noreturn]] void wrong(const std::string& message) const;

 private:
  template <class T>
  double take();
  double next_binary(PlyType type);
  std::string_view next_word();
  void skip_space();
  std::uint32_t checked(const PlyProperty& property, double x) const;

  std::string_view data_;
  bool binary_, swapped_;  ///< swapped: the bytes of a value are in the other order
  std::size_t line_;
  char end_of_line_;
  const std::string& name_;
};

}  // namespace carlo
