#include "support/quotes.h"

#include <fmt/format.h>

#include <algorithm>

namespace carlo {
namespace {

constexpr std::size_t longest = 60;

/// Not the first byte of a UTF-8 character.
bool continues(char byte) {
  return (static_cast<unsigned char>(byte) & 0xc0) == 0x80;
}

/// The number of bytes of the UTF-8 character that the text begins with; 0 if it is none.
std::size_t length_of_character(std::string_view text) {
  const auto first = static_cast<unsigned char>(text[0]);
  const std::size_t length = first < 0x80                    ? 1
                             : first >= 0xc2 && first < 0xe0 ? 2
                             : first >= 0xe0 && first < 0xf0 ? 3
                             : first >= 0xf0 && first < 0xf5 ? 4
                                                             : 0;
  if (length == 0 || length > text.size()) return 0;
  return std::all_of(text.begin() + 1, text.begin() + static_cast<std::ptrdiff_t>(length),
                     continues)
             ? length
             : 0;
}

std::string printable(std::string_view text) {
  std::string out;
  while (!text.empty()) {
    const std::size_t length = length_of_character(text);
    const auto code = static_cast<unsigned char>(text[0]);
    if (length == 0 || code < 0x20 || code == 0x7f) {
      out += fmt::format("\\x{:02x}", code);
    } else {
      out += text.substr(0, length);
    }
    text.remove_prefix(std::max<std::size_t>(length, 1));
  }
  return out;
}

}  // namespace

std::string in_quotes(std::string_view text) {
  std::size_t cut = std::min(text.size(), longest);
  while (cut > 0 && cut < text.size() && continues(text[cut]))
    --cut;  // not inside a character
  return '"' + printable(text.substr(0, cut)) + (cut < text.size() ? "...\"" : "\"");
}

std::string path_in_quotes(const std::filesystem::path& path) {
  const std::string text = path.string();
  std::size_t cut = text.size() > longest ? text.size() - longest : 0;
  while (cut < text.size() && continues(text[cut]))
    ++cut;
  return (cut > 0 ? "\"..." : "\"") + printable(std::string_view(text).substr(cut)) + '"';
}

std::string shell_word(std::string_view word) {
  constexpr std::string_view plain =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+=.,:/@%";
  if (!word.empty() && word.find_first_not_of(plain) == std::string_view::npos) {
    return std::string(word);
  }
  std::string result = "'";
  for (const char c : word)
    result += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return result + "'";
}

}  // namespace carlo
