#include "grader/judge/printed.h"

#include <fmt/core.h>

#include <sstream>

namespace carlo::grader {
namespace {

constexpr std::size_t widest = 80;

/// The first `widest` characters, as bytes of UTF-8 that start one.
std::string cut(const std::string& line) {
  std::size_t characters = 0;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const bool starts = (line[i] & 0xC0) != 0x80;
    if (starts && characters++ == widest) return line.substr(0, i) + " ...";
  }
  return line;
}

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
    out += margin + cut(harmless(line)) + "\n";
  }
  if (more > 0)
    out += fmt::format("{}and {} more {}\n", margin, more, more == 1 ? "line" : "lines");
  return out;
}

}  // namespace carlo::grader
