#include "grader/protocol/rows_text.h"

#include <fmt/core.h>

#include <algorithm>

namespace carlo::grader {
namespace {

/// As wide as the longest double that reads back the same, "-2.2250738585072014e-308".
constexpr std::size_t value_width = 24;

std::string counted(std::size_t count, const std::string& what) {
  return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s");
}

/// A name for each of `count` values; the last of `names` is numbered where it is left to several.
std::vector<std::string> names_of(std::size_t count, const std::vector<std::string>& names) {
  std::vector<std::string> list;
  const std::size_t single = names.size() - 1;
  for (std::size_t i = 0; i < count; ++i) {
    if (i < single || count == names.size()) {
      list.push_back(names[i]);
    } else {
      list.push_back(fmt::format("{} {}", names.back(), i - single + 1));
    }
  }
  return list;
}

/// One value a line.
std::string lines_text(const std::vector<double>& values, const std::vector<std::string>& names) {
  std::size_t width = 0;
  for (const std::string& name : names)
    width = std::max(width, name.size());
  std::string out;
  for (std::size_t i = 0; i < names.size(); ++i)
    out += fmt::format("  {:<{}}  {:>{}}\n", names[i], width, values[i], value_width);
  return out;
}

std::string table_text(const Rows& rows, const std::vector<std::string>& names, std::size_t shown) {
  std::string out = fmt::format("  {:>8}", "row");
  for (const std::string& name : names)
    out += fmt::format("  {:>{}}", name, value_width);
  out += "\n";
  for (std::size_t row = 0; row < shown; ++row) {
    out += fmt::format("  {:>8}", row + 1);
    for (std::size_t column = 0; column < rows.columns; ++column) {
      const std::size_t width = std::max(value_width, names[column].size());
      out += fmt::format("  {:>{}}", rows.at(row, column), width);
    }
    out += "\n";
  }
  return out;
}

}  // namespace

std::string rows_text(const Rows& rows, std::vector<std::string> names, std::size_t most) {
  const std::size_t count = rows.count();
  const std::size_t shown = most == 0 ? count : std::min(most, count);
  const bool list = rows.columns == 1, single = count == 1;
  const bool fit = list ? !names.empty() && names.size() <= std::max<std::size_t>(count, 1)
                        : names.size() == rows.columns;
  if (!fit) names = {"value"};
  std::string out =
      list     ? counted(count, "value")
      : single ? counted(rows.columns, "value")
               : fmt::format("{} of {}", counted(count, "row"), counted(rows.columns, "value"));
  out += shown < count ? fmt::format(" came back; the first {}:\n", shown) : " came back:\n";
  if (count == 0) return list ? "no values came back\n" : "no rows came back\n";
  if (list) {
    std::vector<std::string> lines = names_of(count, names);
    lines.resize(shown);
    out += lines_text(rows.values, lines);
  } else if (single) {
    out += lines_text(rows.values, names_of(rows.columns, names));
  } else {
    out += table_text(rows, names_of(rows.columns, names), shown);
  }
  if (shown < count) out += fmt::format("  ...  {} more: --all\n", count - shown);
  return out;
}

}  // namespace carlo::grader
