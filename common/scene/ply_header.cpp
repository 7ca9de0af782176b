#include "scene/ply_header.h"

#include "scene/text.h"
#include "support/error.h"

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

namespace carlo {
namespace {

using Words = std::vector<std::string_view>;

constexpr std::array<std::pair<std::string_view, PlyType>, 16> type_names = {{
    {"char", PlyType::i8},
    {"int8", PlyType::i8},
    {"uchar", PlyType::u8},
    {"uint8", PlyType::u8},
    {"short", PlyType::i16},
    {"int16", PlyType::i16},
    {"ushort", PlyType::u16},
    {"uint16", PlyType::u16},
    {"int", PlyType::i32},
    {"int32", PlyType::i32},
    {"uint", PlyType::u32},
    {"uint32", PlyType::u32},
    {"float", PlyType::f32},
    {"float32", PlyType::f32},
    {"double", PlyType::f64},
    {"float64", PlyType::f64},
}};

class HeaderParser {
 public:
  HeaderParser(std::string_view text, const std::string& name) : text_(text), name_(name) {}

  PlyHeader parse() {
    if (text_.starts_with("ply\r") && !text_.starts_with("ply\r\n")) header_.end_of_line = '\r';
    if (next_line() != Words{"ply"}) wrong("not a PLY file: the first line must be \"ply\"");
    read_format(next_line());
    while (true) {
      const Words line = next_line();
      if (line == Words{"end_header"}) break;
      if (line.empty() || line[0] == "comment" || line[0] == "obj_info") continue;
      if (line[0] == "element") {
        add_element(line);
      } else if (line[0] == "property") {
        add_property(line);
      } else {
        wrong(fmt::format("{} is not understood", in_quotes(line[0])));
      }
    }
    header_.size = position_;
    header_.lines = line_;
    return header_;
  }

 private:
  Words next_line() {
    if (position_ >= text_.size()) wrong("the header ends before \"end_header\"");
    const std::size_t end = std::min(text_.find(header_.end_of_line, position_), text_.size());
    const std::string_view line = text_.substr(position_, end - position_);
    position_ = std::min(end + 1, text_.size());
    ++line_;
    return words(line);
  }

  void read_format(const Words& line) {
    constexpr std::array<std::string_view, 3> names = {"ascii", "binary_little_endian",
                                                       "binary_big_endian"};
    const bool versioned = line.size() == 3 && line[0] == "format" && line[2] == "1.0";
    const auto found = std::find(names.begin(), names.end(), versioned ? line[1] : "");
    if (found == names.end()) {
      wrong(
          "expected \"format ascii 1.0\", \"format binary_little_endian 1.0\" or \"format "
          "binary_big_endian 1.0\"");
    }
    header_.format = static_cast<PlyFormat>(found - names.begin());
  }

  void add_element(const Words& line) {
    const auto count = line.size() == 3 ? parse_integer(line[2]) : std::nullopt;
    if (!count || *count < 0) wrong("expected \"element NAME COUNT\"");
    header_.elements.push_back({std::string(line[1]), static_cast<std::size_t>(*count), {}});
  }

  void add_property(const Words& line) {
    if (header_.elements.empty()) wrong("a property before the first element");
    PlyProperty property;
    property.name = std::string(line.back());
    if (line.size() == 3) {
      property.type = type(line[1]);
    } else if (line.size() == 5 && line[1] == "list") {
      property.list = true;
      property.count_type = type(line[2]);
      property.type = type(line[3]);
      if (!is_integer(property.count_type)) wrong("a list's length must be of an integer type");
    } else {
      wrong("expected \"property TYPE NAME\" or \"property list TYPE TYPE NAME\"");
    }
    header_.elements.back().properties.push_back(property);
  }

  PlyType type(std::string_view word) const {
    for (const auto& [name, type] : type_names) {
      if (name == word) return type;
    }
    wrong(fmt::format("{} is not a type", in_quotes(word)));
  }

  [[noreturn]] void wrong(const std::string& message) const {
    throw Error("{}:{}: {}", name_, std::max<std::size_t>(line_, 1), message);
  }

  std::string_view text_;
  const std::string& name_;
  std::size_t position_ = 0;
  std::size_t line_ = 0;
  PlyHeader header_;
};

}  // namespace

PlyHeader parse_ply_header(std::string_view text, const std::string& name) {
  return HeaderParser(text, name).parse();
}

bool is_integer(PlyType type) {
  return type != PlyType::f32 && type != PlyType::f64;
}

}  // namespace carlo
