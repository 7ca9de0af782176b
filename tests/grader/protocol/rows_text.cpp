#include "grader/protocol/rows_text.h"

#include <fmt/core.h>

#include <algorithm>
#include <string_view>

namespace carlo::grader {
namespace {

constexpr std::string_view and_so_on = " ...";
constexpr std::size_t screen_width = 80;
/// The width of the longest double that reads back the same, "-2.2250738585072014e-308".
constexpr std::size_t value_width = 24;

std::string counted(std::size_t count, const std::string& what) {
  return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s");
}

bool repeats(const std::string& name) {
  return std::string_view(name).ends_with(and_so_on);
}

/// Returns a name for each of the first `shown` of `count` values in a column; numbers the last of
/// `names` if it stands for several. None if there are more names than values.
std::vector<std::string> names_of_list(std::size_t count, const std::vector<std::string>& names,
                                       std::size_t shown) {
  std::vector<std::string> list;
  if (names.empty() || names.size() > count) return list;
  const std::size_t single = names.size() - 1;
  for (std::size_t i = 0; i < shown; ++i) {
    if (i < single || count == names.size()) {
      list.push_back(names[i]);
    } else {
      list.push_back(fmt::format("{} {}", names.back(), i - single + 1));
    }
  }
  return list;
}

/// Returns a name for each column; none if they do not come out even.
std::vector<std::string> names_of_columns(std::size_t columns,
                                          const std::vector<std::string>& names) {
  const auto repeated =
      static_cast<std::size_t>(std::count_if(names.begin(), names.end(), repeats));
  const std::size_t single = names.size() - repeated;
  std::vector<std::string> list;
  if (repeated == 0 && single != columns) return list;
  if (repeated > 0 && (columns <= single || (columns - single) % repeated != 0)) return list;
  const std::size_t each = repeated == 0 ? 0 : (columns - single) / repeated;
  for (const std::string& name : names) {
    if (!repeats(name)) {
      list.push_back(name);
      continue;
    }
    const std::string stem = name.substr(0, name.size() - and_so_on.size());
    for (std::size_t i = 1; i <= each; ++i)
      list.push_back(fmt::format("{} {}", stem, i));
  }
  return list;
}

/// Returns the first `names.size()` values, one per line.
std::string lines_text(const std::vector<double>& values, const std::vector<std::string>& names) {
  std::size_t width = 0;
  for (const std::string& name : names)
    width = std::max(width, name.size());
  std::string out = counted(values.size(), "value") + " came back";
  out += names.size() < values.size() ? fmt::format("; the first {}:\n", names.size()) : ":\n";
  for (std::size_t i = 0; i < names.size(); ++i)
    out += fmt::format("  {:<{}}  {:>{}}\n", names[i], width, values[i], value_width);
  if (names.size() < values.size())
    out += fmt::format("  ...  {} more: --all\n", values.size() - names.size());
  return out;
}

/// Returns the columns from `first` to before `last` of a table, below their names.
std::string part_text(const Rows& rows, std::size_t shown, const std::vector<std::string>& names,
                      const std::vector<std::size_t>& widths, std::size_t first, std::size_t last) {
  const std::size_t number_width = std::max<std::size_t>(3, std::to_string(shown).size());
  std::string out = fmt::format("  {:>{}}", "row", number_width);
  for (std::size_t column = first; column < last; ++column)
    out += fmt::format("  {:>{}}", names[column], widths[column]);
  out += "\n";
  for (std::size_t row = 0; row < shown; ++row) {
    out += fmt::format("  {:>{}}", row + 1, number_width);
    for (std::size_t column = first; column < last; ++column)
      out += fmt::format("  {:>{}}", rows.at(row, column), widths[column]);
    out += "\n";
  }
  return out;
}

/// Returns `shown` rows of the first `names.size()` columns; columns that do not fit on the screen
/// (0: any width) go below.
std::string table_text(const Rows& rows, std::size_t shown, const std::vector<std::string>& names,
                       std::size_t screen) {
  std::vector<std::size_t> widths;
  for (std::size_t column = 0; column < names.size(); ++column) {
    widths.push_back(names[column].size());
    for (std::size_t row = 0; row < shown; ++row)
      widths.back() = std::max(widths.back(), fmt::format("{}", rows.at(row, column)).size());
  }
  constexpr std::size_t margin = 7;  // where the row numbers are
  std::string out;
  for (std::size_t first = 0; first < names.size();) {
    std::size_t last = first + 1, width = margin + 2 + widths[first];
    while (last < names.size() && (screen == 0 || width + 2 + widths[last] <= screen))
      width += 2 + widths[last++];
    if (first > 0) out += "\n";
    out += part_text(rows, shown, names, widths, first, last);
    first = last;
  }
  return out;
}

std::string left_out(std::size_t rows, std::size_t columns) {
  if (rows == 0 && columns == 0) return "";
  if (columns == 0) return fmt::format("  ...  {} more: --all\n", rows);
  if (rows == 0) return fmt::format("  ...  {} more in each row: --all\n", columns);
  return fmt::format("  ...  {} more, and {} more in each row: --all\n", rows, columns);
}

}  // namespace

bool names_fit(const std::vector<std::string>& names, std::size_t rows, std::size_t columns) {
  return columns == 1 ? !names_of_list(rows, names, 1).empty()
                      : !names_of_columns(columns, names).empty();
}

std::string rows_text(const Rows& rows, std::vector<std::string> names, std::size_t most) {
  const std::size_t count = rows.count();
  if (count == 0) return rows.columns == 1 ? "no values came back\n" : "no rows came back\n";
  if (!names_fit(names, count, rows.columns)) names = {rows.columns == 1 ? "value" : "value ..."};
  const auto of = [&](std::size_t all, std::size_t least) {
    return most == 0 ? all : std::min(all, std::max(most, least));
  };
  if (rows.columns == 1)
    return lines_text(rows.values, names_of_list(count, names, of(count, names.size())));
  std::vector<std::string> columns = names_of_columns(rows.columns, names);
  columns.resize(of(rows.columns, names.size()));
  if (count == 1) return lines_text(rows.values, columns);
  const std::size_t shown = of(count, 0);
  return fmt::format("{} of {} came back{}:\n", counted(count, "row"),
                     counted(rows.columns, "value"),
                     shown < count ? fmt::format("; the first {}", shown) : "") +
         table_text(rows, shown, columns, most == 0 ? 0 : screen_width) +
         left_out(count - shown, rows.columns - columns.size());
}

}  // namespace carlo::grader
