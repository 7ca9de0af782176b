#include "scene/ply_data.h"

#include "scene/text.h"
#include "support/error.h"
#include "support/number.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cctype>
#include <cmath>
#include <cstring>
#include <limits>
#include <optional>
#include <utility>

namespace carlo {
namespace {

constexpr std::string_view space = " \t\r\n";

/// True for a number, even if it is infinite, nan, or outside double's range.
bool is_like_number(std::string_view word) {
  if (word.starts_with('-') || word.starts_with('+')) word.remove_prefix(1);
  if (word.empty()) return false;
  std::string start(word.substr(0, 3));
  for (char& c : start)
    c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return std::isdigit(static_cast<unsigned char>(word[0])) != 0 || word[0] == '.' ||
         start == "nan" || start == "inf";
}

constexpr std::size_t size_of(PlyType type) {
  constexpr std::array<std::size_t, 8> sizes = {1, 1, 2, 2, 4, 4, 4, 8};
  return sizes.at(static_cast<std::size_t>(type));
}

}  // namespace

PlyData::PlyData(std::string_view text, const PlyHeader& header, const std::string& name)
    : data_(text.substr(header.size)),
      binary_(header.format != PlyFormat::ascii),
      swapped_(binary_ && (header.format == PlyFormat::big_endian) !=
                              (std::endian::native == std::endian::big)),
      line_(header.lines + 1),
      end_of_line_(header.end_of_line),
      name_(name) {}

void PlyData::wrong(const std::string& message) const {
  if (binary_) throw Error("{}: {}", name_, message);
  throw Error("{}:{}: {}", name_, line_, message);
}

double PlyData::number(const PlyProperty& property, PlyType type) {
  if (binary_) return next_binary(type);
  const std::string_view word = next_word();
  const auto number = parse_number(word);
  if (!number) {
    wrong(fmt::format("expected {} for {}, got {}", number_wanted(word), property.name,
                      in_quotes(word)));
  }
  return *number;
}

double PlyData::any_number(const PlyProperty& property) {
  if (binary_) return next_binary(property.type);
  const std::string_view word = next_word();
  if (!is_like_number(word))
    wrong(fmt::format("expected a number for {}, got {}", property.name, in_quotes(word)));
  return parse_number(word).value_or(std::numeric_limits<double>::quiet_NaN());
}

std::uint32_t PlyData::whole(const PlyProperty& property, PlyType type) {
  return checked(property, number(property, type));
}

std::optional<std::uint32_t> PlyData::whole_or_end(const PlyProperty& property) {
  const double x = number(property, property.type);
  if (x == -1) return std::nullopt;
  return checked(property, x);
}

std::uint32_t PlyData::checked(const PlyProperty& property, double x) const {
  if (!(x >= 0 && x <= std::numeric_limits<std::uint32_t>::max()) || x != std::floor(x))
    wrong(fmt::format("expected a count or an index for {}, got {}", property.name, x));
  return static_cast<std::uint32_t>(x);
}

void PlyData::skip(const PlyProperty& property) {
  const std::size_t length = property.list ? whole(property, property.count_type) : 1;
  if (binary_) {
    const std::size_t size = size_of(property.type);
    if (data_.size() / size < length) wrong("the file ends too early");
    data_.remove_prefix(size * length);
    return;
  }
  for (std::size_t i = 0; i < length; ++i)
    any_number(property);
}

std::optional<std::string> PlyData::finish() {
  if (!binary_) skip_space();
  const bool end_of_line = data_ == "\n" || data_ == "\r\n" || data_ == "\r";
  if (data_.empty()) return std::nullopt;
  if (!end_of_line) wrong("there is more data than the header announces");
  return fmt::format("{}: an end of line follows the last value and is not used", name_);
}

template <class T>
double PlyData::take() {
  if (data_.size() < sizeof(T)) wrong("the file ends too early");
  std::array<char, sizeof(T)> bytes;
  std::memcpy(bytes.data(), data_.data(), sizeof(T));
  data_.remove_prefix(sizeof(T));
  if (swapped_) std::reverse(bytes.begin(), bytes.end());
  return static_cast<double>(std::bit_cast<T>(bytes));
}

double PlyData::next_binary(PlyType type) {
  switch (type) {
    case PlyType::i8:
      return take<std::int8_t>();
    case PlyType::u8:
      return take<std::uint8_t>();
    case PlyType::i16:
      return take<std::int16_t>();
    case PlyType::u16:
      return take<std::uint16_t>();
    case PlyType::i32:
      return take<std::int32_t>();
    case PlyType::u32:
      return take<std::uint32_t>();
    case PlyType::f32:
      return take<float>();
    case PlyType::f64:
      return take<double>();
  }
  return 0;
}

std::string_view PlyData::next_word() {
  skip_space();
  if (data_.empty()) wrong("the file ends too early");
  const std::string_view word = data_.substr(0, data_.find_first_of(space));
  data_.remove_prefix(word.size());
  return word;
}

void PlyData::skip_space() {
  const std::size_t length = std::min(data_.find_first_not_of(space), data_.size());
  line_ += static_cast<std::size_t>(
      std::count(data_.begin(), data_.begin() + static_cast<std::ptrdiff_t>(length), end_of_line_));
  data_.remove_prefix(length);
}

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
