#include "scene/values.h"

#include "scene/text.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace carlo {
namespace {

// Refractive indices at 589 nm (Bass et al., "Handbook of Optics"; the values of Mitsuba 0.6).
constexpr std::array<std::pair<std::string_view, float>, 9> indices = {{
    {"vacuum", 1.0f},
    {"air", 1.000277f},
    {"water", 1.333f},
    {"water ice", 1.31f},
    {"fused quartz", 1.458f},
    {"pyrex", 1.47f},
    {"acrylic glass", 1.49f},
    {"bk7", 1.5046f},
    {"diamond", 2.419f},
}};

/// The refractive index of a medium by its name in Mitsuba; nothing for unknown names.
std::optional<float> medium_ior(std::string_view name) {
  for (const auto& [medium, ior] : indices) {
    if (medium == name) return ior;
  }
  return {};
}

/// The names of all media.
std::vector<std::string> media() {
  std::vector<std::string> out;
  for (const auto& [medium, ior] : indices)
    out.emplace_back(medium);
  return out;
}

// Light of equal energy at each wavelength (X = Y = Z = 1) in linear sRGB, as in Mitsuba 3.
constexpr Rgb equal_energy{1.2048f, 0.9483f, 0.9089f};

void require_kind(const XmlElement& property, std::initializer_list<std::string_view> kinds) {
  if (std::find(kinds.begin(), kinds.end(), property.name) != kinds.end()) return;
  fail(property.at, "{} must be given as <{}>, got <{}>", property.get("name").written,
       fmt::join(kinds, "> or <"), property.name);
}

std::string lower(std::string text) {
  for (char& c : text)
    c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

/// The bytes of #rrggbb, in units of 255.
std::optional<glm::dvec3> hexadecimal(std::string_view text) {
  if (text.size() != 7 || text[0] != '#') return {};
  glm::dvec3 out;
  for (int i = 0; i < 3; ++i) {
    const char* begin = text.data() + 1 + 2 * i;
    unsigned byte = 0;
    const auto [end, error] = std::from_chars(begin, begin + 2, byte, 16);
    if (error != std::errc() || end != begin + 2) return {};
    out[i] = byte / 255.0;
  }
  return out;
}

// The inverse of sRGB's transfer function (IEC 61966-2-1).
double decoded(double v) {
  return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
}

glm::dvec3 numbers_of(const XmlElement& property, const XmlAttribute& value) {
  const auto parts = words(value.value, ",");
  if (parts.size() == 1 && parts[0].starts_with('#')) {
    if (property.name != "srgb") {
      fail(value.value_at, "a colour as #rrggbb is encoded: <srgb> says so, got <{}>",
           property.name);
    }
    const auto bytes = hexadecimal(parts[0]);
    if (!bytes) fail(value.value_at, "expected #rrggbb, got {}", found(value));
    return *bytes;
  }
  if (parts.size() != 1 && parts.size() != 3) {
    fail(value.value_at, "expected \"r, g, b\" or one number, got {}", found(value));
  }
  if ((property.name == "spectrum" || property.name == "float") && parts.size() != 1) {
    fail(value.value_at, "a <{}> is one number here (grey), got {}; use <rgb>", property.name,
         found(value));
  }
  glm::dvec3 out{0};
  for (std::size_t i = 0; i < 3; ++i) {
    const std::string_view part = parts[parts.size() == 3 ? i : 0];
    const auto number = parse_number(part);
    if (!number) fail(value.value_at, "expected {}, got {}", numbers_wanted(part), found(value));
    out[static_cast<int>(i)] = *number;
  }
  return out;
}

// Negative numbers stay unchanged, to be refused elsewhere.
double linear(double encoded) {
  return encoded > 0 ? decoded(encoded) : encoded;
}

template <class T>
T one_of(const XmlElement& property, std::initializer_list<std::pair<const char*, T>> values) {
  const std::string& text = text_value(property);
  std::vector<std::string> known;
  for (const auto& [word, value] : values) {
    if (text == word) return value;
    known.emplace_back(word);
  }
  wrong(property, "{} is not supported{}", in_quotes(text), suggest(text, known));
}

}  // namespace

std::string found(const XmlAttribute& attribute) {
  if (attribute.value == attribute.written) return in_quotes(attribute.value);
  return fmt::format("{} (from {})", in_quotes(attribute.value), in_quotes(attribute.written));
}

double number_of(const XmlAttribute& attribute) {
  const auto number = parse_number(attribute.value);
  if (!number) {
    fail(attribute.value_at, "{} must be {}, got {}", attribute.name,
         number_wanted(attribute.value), found(attribute));
  }
  return *number;
}

glm::dvec3 triple_of(const XmlAttribute& attribute) {
  const auto parts = words(attribute.value, ",");
  glm::dvec3 out{0};
  for (std::size_t i = 0; i < 3; ++i) {
    const auto number = parts.size() == 3 ? parse_number(parts[i]) : std::nullopt;
    if (!number) {
      fail(attribute.value_at, "{} must be three {}, got {}", attribute.name,
           numbers_wanted(parts.size() == 3 ? parts[i] : ""), found(attribute));
    }
    out[static_cast<int>(i)] = *number;
  }
  return out;
}

float number_value(const XmlElement& property) {
  require_kind(property, {"float"});
  const XmlAttribute& value = property.get("value");
  const auto number = parse_number(value.value);
  if (!number) wrong(property, "must be {}, got {}", number_wanted(value.value), found(value));
  return static_cast<float>(*number);
}

int integer_value(const XmlElement& property) {
  require_kind(property, {"integer"});
  const XmlAttribute& value = property.get("value");
  const auto number = parse_integer(value.value);
  if (number) return *number;
  // A whole number that no int holds is an integer, too.
  const auto real = parse_number(value.value);
  if (!real || std::abs(*real) <= std::numeric_limits<int>::max() || *real != std::floor(*real))
    wrong(property, "must be an integer, got {}", found(value));
  wrong(property, "must be an integer from {} to {}, got {}", std::numeric_limits<int>::min(),
        std::numeric_limits<int>::max(), found(value));
}

bool boolean_value(const XmlElement& property) {
  require_kind(property, {"boolean"});
  const XmlAttribute& value = property.get("value");
  const std::string word = lower(value.value);
  if (word != "true" && word != "false")
    wrong(property, "must be true or false, got {}", found(value));
  return word == "true";
}

const std::string& text_value(const XmlElement& property) {
  require_kind(property, {"string"});
  return property.get("value").value;
}

glm::dvec3 point_value(const XmlElement& property) {
  require_kind(property, {"point", "vector"});
  if (const XmlAttribute* value = property.find("value")) return triple_of(*value);
  return glm::dvec3(number_of(property.get("x")), number_of(property.get("y")),
                    number_of(property.get("z")));
}

Rgb colour_value(const XmlElement& property) {
  require_kind(property, {"rgb", "srgb", "spectrum", "float"});
  const XmlAttribute& value = property.get("value");
  glm::dvec3 numbers = numbers_of(property, value);
  if (property.name == "srgb") numbers = {linear(numbers.r), linear(numbers.g), linear(numbers.b)};
  return Rgb(numbers);
}

bool is_equal_energy(const XmlElement& property) {
  return property.name == "spectrum" && property.at.source->dialect == Dialect::mitsuba3;
}

Rgb emission_value(const XmlElement& property) {
  const Rgb colour = colour_value(property);
  return is_equal_energy(property) ? colour * equal_energy : colour;
}

float ior_value(const XmlElement& property) {
  require_kind(property, {"float", "string"});
  if (property.name == "float") return number_value(property);
  const std::string& medium = text_value(property);
  const auto ior = medium_ior(medium);
  if (!ior) wrong(property, "names no medium: {}{}", in_quotes(medium), suggest(medium, media()));
  return *ior;
}

FovAxis fov_axis_value(const XmlElement& property) {
  return one_of<FovAxis>(property, {{"x", FovAxis::x},
                                    {"y", FovAxis::y},
                                    {"smaller", FovAxis::smaller},
                                    {"larger", FovAxis::larger}});
}

sdf::Operation operation_value(const XmlElement& property) {
  return one_of<sdf::Operation>(property, {{"union", sdf::Operation::unite},
                                           {"intersection", sdf::Operation::intersect},
                                           {"difference", sdf::Operation::subtract}});
}

}  // namespace carlo
