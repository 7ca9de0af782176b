#include "scene/text.h"

#include "support/number.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace carlo {
namespace {

constexpr std::string_view white_space = " \t\r\n";

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(white_space);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(white_space) - first + 1);
}

// number_of() accepts no leading plus sign.
std::string_view without_plus(std::string_view text) {
  const bool plus = text.size() > 1 && text[0] == '+' && text[1] != '-' && text[1] != '+';
  return plus ? text.substr(1) : text;
}

void skip_sign(std::string_view& text) {
  if (text.starts_with('+') || text.starts_with('-')) text.remove_prefix(1);
}

/// Returns how many there were.
std::size_t skip_digits(std::string_view& text) {
  const std::size_t count = std::min(text.find_first_not_of("0123456789"), text.size());
  text.remove_prefix(count);
  return count;
}

/// True for a decimal number, however large or small.
bool is_written_as_number(std::string_view text) {
  skip_sign(text);
  std::size_t digits = skip_digits(text);
  if (text.starts_with('.')) {
    text.remove_prefix(1);
    digits += skip_digits(text);
  }
  if (digits == 0) return false;
  if (text.empty()) return true;
  const bool exponent = text.starts_with('e') || text.starts_with('E');
  text.remove_prefix(1);
  skip_sign(text);
  return exponent && skip_digits(text) > 0 && text.empty();
}

// Levenshtein distance, row by row of its table.
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i + 1;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t replaced = diagonal + (a[i] == b[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({replaced, row[j] + 1, row[j + 1] + 1});
    }
  }
  return row.back();
}

}  // namespace

bool is_near(std::string_view text, std::string_view name) {
  const std::size_t distance = edit_distance(text.substr(0, 100), name);
  return distance <= 2 && distance < name.size();
}

std::string suggest(std::string_view text, const std::vector<std::string>& candidates) {
  constexpr std::size_t few = 24;
  text = text.substr(0, 100);  // no typing error is that long, and the table is quadratic
  const std::string* nearest = nullptr;
  std::size_t best = std::max<std::size_t>(2, text.size() / 3) + 1;
  for (const std::string& candidate : candidates) {
    const std::size_t distance = edit_distance(text, candidate);
    if (distance < best && distance < candidate.size()) {
      best = distance;
      nearest = &candidate;
    }
  }
  if (nearest != nullptr) return fmt::format(" (did you mean {}?)", in_quotes(*nearest));
  if (candidates.empty() || candidates.size() > few) return "";
  return fmt::format(" (expected {}{})", candidates.size() > 1 ? "one of " : "",
                     fmt::join(candidates, ", "));
}

char end_of_line(std::string_view text) {
  return text.find('\n') == std::string_view::npos ? '\r' : '\n';
}

std::vector<std::string_view> words(std::string_view text, std::string_view separators) {
  const std::string between = std::string(white_space) + std::string(separators);
  std::vector<std::string_view> out;
  std::size_t begin = text.find_first_not_of(between);
  while (begin != std::string_view::npos) {
    const std::size_t end = std::min(text.find_first_of(between, begin), text.size());
    out.push_back(text.substr(begin, end - begin));
    begin = text.find_first_not_of(between, end);
  }
  return out;
}

std::optional<double> parse_number(std::string_view text) {
  const std::optional<double> value = number_of<double>(without_plus(trimmed(text)));
  constexpr double most = std::numeric_limits<float>::max();
  // Written so that NaN fails.
  return value && std::abs(*value) <= most ? value : std::nullopt;
}

std::string_view number_wanted(std::string_view text) {
  return is_written_as_number(trimmed(text)) ? "a number within float's range" : "a finite number";
}

std::string_view numbers_wanted(std::string_view text) {
  return is_written_as_number(trimmed(text)) ? "numbers within float's range" : "finite numbers";
}

std::optional<int> parse_integer(std::string_view text) {
  return number_of<int>(without_plus(trimmed(text)));
}

}  // namespace carlo
