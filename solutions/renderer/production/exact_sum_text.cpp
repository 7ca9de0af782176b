#include "renderer/production/exact_sum_text.h"

#include "support/number.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cstddef>

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

std::string to_text(const PixelCovariance& covariance) {
  std::string text = to_text(covariance.splats);
  for (const ExactSum& sum : covariance.shared)
    text += ", " + to_text(sum);
  return text;
}

std::optional<PixelCovariance> pixel_covariance_of(std::string_view text) {
  PixelCovariance covariance;
  constexpr std::string_view comma = ", ";
  for (ExactSum* const sum : {&covariance.splats, covariance.shared.data(), &covariance.shared[1],
                              &covariance.shared[2]}) {
    const std::size_t length = text.find(comma);
    const bool last = sum == &covariance.shared[2];
    if (last != (length == std::string_view::npos)) return std::nullopt;
    const auto value = exact_sum_of(text.substr(0, length));
    if (!value) return std::nullopt;
    *sum = *value;
    if (!last) text.remove_prefix(length + comma.size());
  }
  return covariance;
}

}  // namespace carlo
