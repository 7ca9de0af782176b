#include "grader/grade/handed_in.h"

#include <fmt/core.h>

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <system_error>

namespace carlo::grader {

bool is_folder(const std::filesystem::directory_entry& entry) {
  std::error_code ec;
  return !entry.is_symlink(ec) && entry.is_directory(ec);
}

bool is_harmless_utf8(const std::string& text) {
  for (std::size_t i = 0; i < text.size();) {
    const auto byte = [&](std::size_t at) {
      return at < text.size() ? static_cast<unsigned char>(text[at]) : 0U;
    };
    const unsigned first = byte(i);
    const std::size_t length = first < 0x80   ? 1
                               : first < 0xC2 ? 0
                               : first < 0xE0 ? 2
                               : first < 0xF0 ? 3
                               : first < 0xF5 ? 4
                                              : 0;
    if (length == 0) return false;
    for (std::size_t k = 1; k < length; ++k) {
      if ((byte(i + k) & 0xC0) != 0x80) return false;
    }
    if (first == 0xC2 && byte(i + 1) < 0xA1) return false;
    if (first == 0xE2 && (byte(i + 1) == 0x80 || byte(i + 1) == 0x81)) return false;
    if (first == 0xEF && (byte(i + 1) == 0xBC || byte(i + 1) == 0xBF)) return false;
    i += length;
  }
  return true;
}

std::string folder_name(const std::string& wanted, std::vector<std::string>& taken) {
  const bool keep_letters = is_harmless_utf8(wanted);
  std::string name;
  for (const char c : wanted.substr(0, 100)) {
    const auto byte = static_cast<unsigned char>(c);
    const bool plain = std::isalnum(byte) != 0 || c == '.' || c == '_' || c == '-';
    name += (byte < 0x80 && plain) || (byte >= 0x80 && keep_letters) ? c : '_';
  }
  while (!name.empty() && !is_harmless_utf8(name))  // cut within a character
    name.pop_back();
  while (!name.empty() && (name.front() == '.' || name.front() == '-'))
    name.erase(0, 1);
  if (name.empty()) name = "unnamed";
  std::string unique = name;
  for (int i = 2; std::find(taken.begin(), taken.end(), unique) != taken.end(); ++i)
    unique = fmt::format("{}-{}", name, i);
  taken.push_back(unique);
  return unique;
}

}  // namespace carlo::grader
