#include "renderer/production/exact_sum_text.h"

#include "support/number.h"

#include <fmt/core.h>

#include <algorithm>

namespace carlo {

std::string to_text(const ExactSum& sum) {
  std::string text;
  for (const std::uint32_t word : sum.words())
    text += fmt::format("{}{}", text.empty() ? "" : " ", word);
  return text;
}

std::optional<ExactSum> exact_sum_of(std::string_view text) {
  if (text.ends_with(' ')) return std::nullopt;
  std::array<std::uint32_t, ExactSum::words_count> words{};
  for (std::uint32_t& word : words) {
    const std::string_view digits = text.substr(0, text.find(' '));
    const auto value = number_of<std::uint32_t>(digits);
    if (!value) return std::nullopt;
    word = *value;
    text.remove_prefix(std::min(digits.size() + 1, text.size()));
  }
  if (!text.empty()) return std::nullopt;
  return ExactSum::from_words(words);
}

}  // namespace carlo
