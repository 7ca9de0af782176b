#pragma once

#include <charconv>
#include <optional>
#include <string_view>
#include <system_error>
#include <type_traits>

namespace carlo {

/// number_of() by means of the C library, for standard libraries whose from_chars() reads only
/// integers: LLVM's before version 20, and so macOS's.
std::optional<double> number_by_strtod(std::string_view text);

/// Parses the whole text as a number, without blanks or a leading plus sign; nothing if it is
/// anything else or out of range.
template <class Number>
std::optional<Number> number_of(std::string_view text) {
#if !defined(__cpp_lib_to_chars)
  if constexpr (std::is_floating_point_v<Number>) {
    static_assert(std::is_same_v<Number, double>, "a float would be rounded twice");
    return number_by_strtod(text);
  } else
#endif
  {
    Number value{};
    const char* const end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, value);
    if (error != std::errc{} || stop != end) return std::nullopt;
    return value;
  }
}

}  // namespace carlo
