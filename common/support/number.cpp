#include "support/number.h"

#include <clocale>
#include <cmath>
#include <string>

#if __has_include(<xlocale.h>)
#include <xlocale.h>  // strtod_l(), on macOS
#endif

namespace carlo {
namespace {

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

/// strtod() also takes blanks, a plus sign and hexadecimal digits.
bool is_decimal(std::string_view text) {
  if (text.starts_with('-')) text.remove_prefix(1);
  if (text == "inf" || text == "nan" || text == "infinity") return true;
  for (const char c : text) {
    if (!is_digit(c) && c != '.' && c != 'e' && c != 'E' && c != '+' && c != '-') return false;
  }
  return !text.empty() && (is_digit(text.front()) || text.front() == '.');
}

}  // namespace

std::optional<double> number_by_strtod(std::string_view text) {
  if (!is_decimal(text)) return std::nullopt;
  // A point is a decimal point here whatever the program's locale.
  static const locale_t plain = ::newlocale(LC_ALL_MASK, "C", nullptr);
  const std::string terminated(text);
  char* end = nullptr;
  const double value = ::strtod_l(terminated.c_str(), &end, plain);
  if (end != terminated.c_str() + terminated.size()) return std::nullopt;
  // Digits whose value overflows or underflows.
  const bool zero =
      value == 0 &&
      text.substr(0, text.find_first_of("eE")).find_first_of("123456789") != text.npos;
  if (zero || (std::isinf(value) && text.find("inf") == text.npos)) return std::nullopt;
  return value;
}

}  // namespace carlo
