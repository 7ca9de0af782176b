#include "course/cli/wrap.h"
#include "course/guide/compiler_messages.h"
#include "support/terminal.h"

#include <fmt/core.h>

#include <algorithm>
#include <cstddef>
#include <sstream>
#include <string>
#include <vector>

namespace carlo {
namespace {

/// Shifts the source line and the marker line below it to the left and cuts both to the width of
/// the terminal: wrapped, they would no longer line up.
std::vector<std::string> narrowed(std::vector<std::string> excerpt) {
  const auto columns = static_cast<std::size_t>(stdout_columns());
  if (columns < 40 || excerpt.empty()) return excerpt;
  const std::size_t bar = excerpt.front().find('|');
  const std::size_t code = bar == std::string::npos ? 0 : bar + 2;
  const std::size_t mark = excerpt.back().find_first_of("^~", code);
  // A third of the visible text stands behind the mark.
  std::size_t skip = 0;
  if (mark != std::string::npos && mark + 3 > columns) skip = mark - columns * 2 / 3;
  for (std::string& line : excerpt) {
    if (skip > 0 && line.size() > code) line.erase(code, skip);
    if (line.size() > columns) line.resize(columns - 1);
  }
  return excerpt;
}

std::string in_full(const CompilerMessage& message) {
  std::string text;
  if (!message.file.empty()) text += message.file + ":";
  if (message.line > 0) text += fmt::format("{}:", message.line);
  if (message.column > 0) text += fmt::format("{}:", message.column);
  if (!text.empty()) text = coloured(Colour::bold, text) + " ";
  text += message.error ? coloured(Colour::red, "error: ") : coloured(Colour::yellow, "warning: ");
  text += message.text + "\n";
  for (const std::string& line : narrowed(message.excerpt))
    text += line + "\n";
  if (!message.found_in.empty()) {
    text += coloured(Colour::dim, fmt::format("      (noticed in {})", message.found_in)) + "\n";
  }
  return text;
}

bool is_command(const std::string& line) {
  return line.rfind("ninja: ", 0) == 0 || line.rfind("FAILED: ", 0) == 0 || line.front() == '@' ||
         line.find("-o CMakeFiles/") != std::string::npos || line.rfind("/usr/bin/c", 0) == 0 ||
         line.rfind(": && ", 0) == 0;
}

}  // namespace

std::string compiler_text(const std::vector<CompilerMessage>& messages, std::size_t most) {
  // With errors, warnings are about code that was not understood. Errors come first.
  const auto errors = static_cast<std::size_t>(std::count_if(
      messages.begin(), messages.end(), [](const CompilerMessage& m) { return m.error; }));
  const std::size_t count = errors > 0 ? errors : messages.size();
  std::string text;
  for (std::size_t i = 0; i < std::min(most, count); ++i)
    text += in_full(messages[i]);
  if (count > most) {
    text += fmt::format("and {} more {}{}\n", count - most, errors > 0 ? "error" : "warning",
                        count - most == 1 ? "" : "s");
  }
  return text;
}

std::string plain_log(std::string_view log, std::size_t lines) {
  std::vector<std::string> kept;
  std::istringstream stream{std::string(log)};
  for (std::string line; std::getline(stream, line);) {
    if (!line.empty() && !is_command(line)) kept.push_back(line);
  }
  std::string text;
  for (std::size_t i = kept.size() - std::min(lines, kept.size()); i < kept.size(); ++i)
    text += kept[i] + "\n";
  return text;
}

}  // namespace carlo
