#include "course/report/format.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace carlo {

namespace {

std::string without_trailing_zeros(std::string digits) {
  if (digits.find('.') == std::string::npos) return digits;
  digits.erase(digits.find_last_not_of('0') + 1);
  if (digits.back() == '.') digits.pop_back();
  return digits;
}

}  // namespace

std::string number_text(double value, int digits) {
  const double size = std::fabs(value);
  if (!std::isfinite(value) || value == 0) return fmt::format("{}", value);
  const std::string scientific = fmt::format("{:.{}e}", value, std::max(0, digits - 1));
  const std::size_t e = scientific.find('e');
  // The exponent after rounding: 999.96 to four digits is 1000.
  const int exponent = std::stoi(scientific.substr(e + 1));
  if (size >= 1e-3 && exponent < 6) {
    return without_trailing_zeros(
        fmt::format("{:.{}f}", value, std::max(0, digits - 1 - exponent)));
  }
  return fmt::format("{}e{}", without_trailing_zeros(scientific.substr(0, e)), exponent);
}

std::string count_text(std::int64_t count) {
  std::string text = fmt::format("{}", count);
  const std::size_t first = count < 0 ? 1 : 0;
  if (text.size() - first < 5) return text;
  for (std::size_t at = text.size(); at > first + 3;) {
    at -= 3;
    text.insert(at, "\u2009");
  }
  return text;
}

std::string duration_text(double seconds) {
  struct Unit {
    double size;
    const char* name;
  };
  constexpr std::array<Unit, 4> units = {{{1, "s"}, {1e-3, "ms"}, {1e-6, "µs"}, {1e-9, "ns"}}};
  if (!std::isfinite(seconds)) return fmt::format("{}", seconds);
  for (const Unit& unit : units) {
    // Just under a unit is rounded up to one: "1 ms", not "1000 µs".
    if (std::fabs(seconds) >= 0.9995 * unit.size) {
      return fmt::format("{} {}", number_text(seconds / unit.size, 3), unit.name);
    }
  }
  return fmt::format("{} ns", number_text(seconds / 1e-9, 3));
}

std::string interval_text(double value, double half_width) {
  if (!std::isfinite(value) || !std::isfinite(half_width)) {
    return fmt::format("{} ± {}", number_text(value), number_text(half_width));
  }
  if (half_width <= 0) return fmt::format("{} ± 0", number_text(value));
  const int place = static_cast<int>(std::floor(std::log10(half_width)));
  const int decimals = std::clamp(1 - place, 0, 8);
  return fmt::format("{:.{}f} ± {:.{}f}", value, decimals, half_width, decimals);
}

}  // namespace carlo
