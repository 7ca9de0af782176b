#include "course/verdict/printed.h"

#include "course/cli/wrap.h"

#include <fmt/core.h>

#include <sstream>

namespace carlo {
namespace {

constexpr std::size_t widest = 80;

}  // namespace

std::string harmless(std::string text) {
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto c = static_cast<unsigned char>(text[i]);
    const auto next = i + 1 < text.size() ? static_cast<unsigned char>(text[i + 1]) : 0U;
    if (c < 32 || c == 127) text[i] = ' ';
    if (c == 0xC2 && next >= 0x80 && next < 0xA0) text[i] = text[i + 1] = ' ';
  }
  return text;
}

std::string clipped(std::string text, std::size_t bytes) {
  if (text.size() <= bytes) return text;
  const auto is_continuation = [&](std::size_t at) {
    return (static_cast<unsigned char>(text[at]) & 0xC0) == 0x80;
  };
  // Invalid UTF-8 may have no end.
  std::size_t end = bytes;
  while (end > 0 && bytes - end < 3 && is_continuation(end))
    --end;
  text.resize(end);
  return text + "...";
}

std::string printed_lines(const TestRecord& test, std::size_t most, const std::string& margin) {
  std::string out;
  std::istringstream lines(test.printed);
  std::size_t shown = 0, more = test.lost_lines;
  for (std::string line; std::getline(lines, line);) {
    if (shown == most) {
      ++more;
      continue;
    }
    ++shown;
    out += margin + shortened(harmless(line), widest) + "\n";
  }
  if (more > 0)
    out += fmt::format("{}and {} more {}\n", margin, more, more == 1 ? "line" : "lines");
  return out;
}

}  // namespace carlo
