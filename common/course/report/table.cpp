#include "course/report/table.h"

#include "course/cli/wrap.h"
#include "course/report/format.h"
#include "course/report/html.h"
#include "support/error.h"
#include "support/terminal.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

namespace carlo {
namespace {

std::string padded(const std::string& text, std::size_t width, bool right) {
  const std::string blank(width - std::min(width, display_width(text)), ' ');
  return right ? blank + text : text + blank;
}

using Columns = std::vector<std::size_t>;

/// Between two columns.
constexpr std::size_t gap = 2;
/// Text in the last column may wrap if this width or more is left.
constexpr std::size_t least_words = 20;

/// Returns whether no two rows have the same text in the first `names` columns.
bool tell_apart(const std::vector<std::vector<Cell>>& rows, std::size_t names) {
  std::set<std::vector<std::string>> seen;
  return std::all_of(rows.begin(), rows.end(), [&](const std::vector<Cell>& row) {
    std::vector<std::string> words;
    for (std::size_t c = 0; c < names; ++c)
      words.push_back(row[c].text);
    return seen.insert(std::move(words)).second;
  });
}

/// Returns where column `c` begins in a block.
std::size_t start_of(std::size_t c, const Columns& block, const std::vector<std::size_t>& widths) {
  std::size_t at = 0;
  for (const std::size_t before : block) {
    if (before == c) break;
    at += widths[before] + gap;
  }
  return at;
}

/// Splits the columns into blocks no wider than `room`; the first `names` columns are in every
/// block.
std::vector<Columns> blocks_of(const std::vector<std::size_t>& widths, std::size_t names,
                               std::size_t room) {
  Columns block(names);
  std::iota(block.begin(), block.end(), std::size_t{0});
  const Columns front = block;
  std::vector<Columns> blocks;
  for (std::size_t c = names; c < widths.size(); ++c) {
    block.push_back(c);
    if (block.size() == names + 1 || start_of(c, block, widths) + widths[c] <= room) continue;
    block.pop_back();
    blocks.push_back(block);
    block = front;
    block.push_back(c);
  }
  blocks.push_back(block);
  return blocks;
}

/// Wraps a line whose last column, of text, begins at `column`: the rest continues below in that
/// column, if enough room is left for it.
std::string fitted(const std::string& line, const std::string& words, std::size_t column,
                   int columns) {
  const auto room = columns - static_cast<int>(column);
  const bool wide = display_width(words) > static_cast<std::size_t>(std::max(room, 0));
  if (room < static_cast<int>(least_words) || !wide) return line;
  std::string below = wrapped_to(words, room);
  below.pop_back();
  for (std::size_t at = 0; (at = below.find('\n', at)) != std::string::npos; at += column + 1)
    below.insert(at + 1, column, ' ');
  return line.substr(0, line.size() - words.size()) + below;
}

std::string without_trailing_spaces(std::string line) {
  line.erase(line.find_last_not_of(' ') + 1);
  return line;
}

}  // namespace

Cell::Cell(double number) : text(number_text(number)), value(number) {}
Cell::Cell(std::int64_t count) : text(count_text(count)), value(static_cast<double>(count)) {}

Cell number_cell(double value, int digits) {
  return {number_text(value, digits), value};
}

Cell percent_cell(double share, int digits) {
  return {number_text(100 * share, digits) + " %", share};
}

Cell seconds_cell(double seconds) {
  return {duration_text(seconds), seconds};
}

Cell interval_cell(double value, double half_width) {
  return {interval_text(value, half_width), value};
}

Cell empty_cell() {
  return {"–", std::nan("")};
}

Table::Table(std::vector<std::string> titles, std::vector<std::string> keys)
    : titles_(std::move(titles)), keys_(std::move(keys)) {
  if (titles_.empty()) throw Error("a table needs at least one column");
  if (keys_.empty()) keys_ = titles_;
  if (keys_.size() != titles_.size()) {
    throw Error("a table got {} titles and {} keys", titles_.size(), keys_.size());
  }
}

void Table::add_row(std::vector<Cell> cells) {
  if (cells.size() != titles_.size()) {
    throw Error("a table row has {} cells, expected {}", cells.size(), titles_.size());
  }
  rows_.push_back(std::move(cells));
}

bool Table::numeric(std::size_t column) const {
  return !rows_.empty() && std::all_of(rows_.begin(), rows_.end(), [&](const auto& row) {
    return row[column].value.has_value();
  });
}

std::string Table::text() const {
  return text(stdout_columns());
}

namespace {

/// A table's columns as text() needs them, computed once.
struct Layout {
  std::vector<bool> numeric;
  std::vector<std::size_t> widths, needed;
  std::size_t names = 0;  ///< leading columns that name the rows

  explicit Layout(const Table& table) {
    const std::size_t count = table.titles().size();
    for (std::size_t c = 0; c < count; ++c) {
      numeric.push_back(table.numeric(c));
      std::size_t width = display_width(table.titles()[c]);
      for (const auto& row : table.rows())
        width = std::max(width, display_width(row[c].text));
      widths.push_back(width);
      needed.push_back(breaks(c, count) ? std::min(width, least_words) : width);
      if (names == c && !numeric[c]) ++names;
    }
    // If all columns are text, or none in front is, the first column names the rows.
    if (names == count || names == 0) names = 1;
    names = std::min(names, count - 1);
    while (names + 1 < count && !tell_apart(table.rows(), names))
      ++names;
  }

  /// Returns whether text in a column may wrap: only in the last one, if it is text.
  bool breaks(std::size_t c, std::size_t count) const { return c + 1 == count && !numeric[c]; }
};

}  // namespace

std::string Table::text(int columns) const {
  const Layout layout(*this);
  const std::size_t room = columns > 0 ? static_cast<std::size_t>(columns) : std::string::npos;
  std::string result;
  for (const Columns& block : blocks_of(layout.needed, layout.names, room)) {
    const auto line = [&](const auto& text_of) {
      std::string text;
      for (const std::size_t c : block)
        text += padded(text_of(c), layout.widths[c], layout.numeric[c]) + std::string(gap, ' ');
      return without_trailing_spaces(std::move(text));
    };
    result += result.empty() ? "" : "\n";
    result += coloured(Colour::bold, line([&](std::size_t c) { return titles_[c]; })) + '\n';
    const std::size_t last = block.back(), start = start_of(last, block, layout.widths);
    const bool breaks = layout.breaks(last, titles_.size());
    for (const auto& row : rows_) {
      const std::string whole = line([&](std::size_t c) { return row[c].text; });
      result += breaks ? fitted(whole, row[last].text, start, columns) : whole;
      result += '\n';
    }
  }
  return result;
}

std::string Table::html(std::string_view caption) const {
  // On a phone each row of many cells becomes a list, with the column titles in front.
  const bool wide = titles_.size() > 4;
  std::string html = fmt::format(
      "<div class=\"scroll\" tabindex=\"0\" role=\"group\" aria-label=\"Table\"><table{}>\n",
      wide ? " class=\"wide\"" : "");
  if (!caption.empty()) {
    html += fmt::format("<caption><span>{}</span></caption>\n", html_typeset(caption));
  }
  const auto add = [&](std::string_view tag, std::size_t c, const std::string& title,
                       const std::string& text) {
    html += fmt::format("<{0}{1}{2}>{3}</{0}>", tag, numeric(c) ? " class=\"number\"" : "", title,
                        html_typeset(text));
  };
  html += "<thead><tr>";
  for (std::size_t c = 0; c < titles_.size(); ++c)
    add("th", c, "", titles_[c]);
  html += "</tr></thead>\n<tbody>\n";
  for (const auto& cells : rows_) {
    html += "<tr>";
    for (std::size_t c = 0; c < cells.size(); ++c) {
      add("td", c, wide ? fmt::format(" data-title=\"{}\"", html_escaped(titles_[c])) : "",
          cells[c].text);
    }
    html += "</tr>\n";
  }
  return html + "</tbody></table></div>\n";
}

}  // namespace carlo
