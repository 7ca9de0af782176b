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

}  // namespace carlo
