#pragma once

#include <charconv>
#include <optional>
#include <string_view>
#include <system_error>

namespace carlo {

/// The number that the whole text is, without blanks or a leading plus sign; nothing when it is
/// anything else, or more than the type holds.
template <class Number>
std::optional<Number> number_of(std::string_view text) {
  Number value{};
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc{} || stop != end) return std::nullopt;
  return value;
}

}  // namespace carlo
