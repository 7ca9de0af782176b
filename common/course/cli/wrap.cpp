#include "course/cli/wrap.h"

#include <fmt/core.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <sstream>
#include <vector>

namespace carlo {
namespace {

bool starts_character(char c) {
  return (static_cast<unsigned char>(c) & 0xC0) != 0x80;
}

/// One character with its colour; the escape sequence takes no columns.
struct Glyph {
  std::string bytes;
  int width = 0;
};

std::vector<Glyph> glyphs(const std::string& line) {
  std::vector<Glyph> list;
  for (std::size_t i = 0; i < line.size();) {
    std::size_t end = i + 1;
    const bool escape = line[i] == '\x1b';
    if (escape) {
      end = std::min(line.find('m', i), line.size() - 1) + 1;
    } else {
      while (end < line.size() && !starts_character(line[end]))
        ++end;
    }
    list.push_back({line.substr(i, end - i), escape ? 0 : 1});
    i = end;
  }
  return list;
}

std::string wrapped_line(const std::string& line, int columns) {
  const std::vector<Glyph> all = glyphs(line);
  const std::size_t first = line.find_first_not_of(' ');
  const int indent = first == std::string::npos
                         ? 0
                         : static_cast<int>(std::min(first, static_cast<std::size_t>(columns / 2)));
  std::string out;
  std::size_t from = 0;
  int room = columns;
  while (from < all.size()) {
    int used = 0;
    std::size_t end = from, space = from;
    for (; end < all.size() && used + all[end].width <= room; ++end) {
      used += all[end].width;
      if (all[end].bytes == " ") space = end;
    }
    // Break at a space, unless it is part of the indentation.
    const bool parted = end < all.size() && space > from + static_cast<std::size_t>(indent);
    const std::size_t last = parted ? space : end;
    for (std::size_t i = from; i < last; ++i)
      out += all[i].bytes;
    from = parted ? space + 1 : end;
    if (from < all.size()) out.append(1, '\n').append(static_cast<std::size_t>(indent), ' ');
    room = columns - indent;
  }
  return out;
}

}  // namespace

std::size_t display_width(std::string_view text) {
  return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), starts_character));
}

std::string shortened(const std::string& text, std::size_t most) {
  if (display_width(text) <= most) return text;
  std::string out;
  std::size_t shown = 0;
  for (const char c : text) {
    if (starts_character(c) && ++shown >= most) break;
    out += c;
  }
  return out + "…";
}

std::string without_escapes(std::string_view text) {
  std::string out;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '\x1b') {
      out += text[i];
      continue;
    }
    i = text.find_first_of("mK", i);
    if (i == std::string_view::npos) break;
  }
  return out;
}

std::string wrapped_to(const std::string& text, int columns) {
  std::string out;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);)
    out += wrapped_line(line, std::max(columns, 20)) + "\n";
  return out;
}

int stdout_columns() {
  winsize size{};
  return ::ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 ? size.ws_col : 0;
}

std::size_t room_beside(std::size_t others, std::size_t least) {
  const auto columns = static_cast<std::size_t>(stdout_columns());
  if (columns == 0) return std::string::npos;
  return columns > others + least ? columns - others : least;
}

std::string wrapped(const std::string& text, int most) {
  const int terminal = stdout_columns();
  const int columns = terminal > 0 && most > 0 ? std::min(terminal, most) : terminal + most;
  if (columns == 0 || text.empty()) return text;
  std::string out = wrapped_to(text, columns);
  if (text.back() != '\n') out.pop_back();
  return out;
}

std::string first_rows(const std::string& text, int rows, const std::string& what) {
  const auto count = static_cast<int>(std::count(text.begin(), text.end(), '\n'));
  if (count <= rows) return text;
  std::istringstream lines(text);
  std::string out, line;
  for (int i = 0; i + 1 < rows && std::getline(lines, line); ++i)
    out += line + "\n";
  return out + fmt::format("... {} more lines: {}\n", count - std::max(rows - 1, 0), what);
}

}  // namespace carlo
