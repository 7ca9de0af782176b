#include "report/table.h"

#include "cli/error.h"
#include "cli/terminal.h"
#include "cli/wrap.h"
#include "report/format.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace carlo {
namespace {

std::string padded(const std::string& text, std::size_t width, bool right) {
  const std::string gap(width - std::min(width, display_width(text)), ' ');
  return right ? gap + text : text + gap;
}

/// A line whose last column, of words, begins at `column`: what is too wide for the terminal goes
/// on below in that column, as long as some room is left for it.
std::string fitted(const std::string& line, const std::string& words, std::size_t column) {
  const auto room = stdout_columns() - static_cast<int>(column);
  if (room < 20 || display_width(words) <= static_cast<std::size_t>(room)) return line;
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
  std::vector<std::size_t> widths;
  for (std::size_t c = 0; c < titles_.size(); ++c) {
    std::size_t width = display_width(titles_[c]);
    for (const auto& row : rows_)
      width = std::max(width, display_width(row[c].text));
    widths.push_back(width);
  }
  const auto line = [&](const auto& text_of) {
    std::string result;
    for (std::size_t c = 0; c < titles_.size(); ++c) {
      if (c > 0) result += "  ";
      result += padded(text_of(c), widths[c], numeric(c));
    }
    return without_trailing_spaces(std::move(result));
  };
  std::string result = coloured(Colour::bold, line([&](std::size_t c) { return titles_[c]; }));
  result += '\n';
  std::size_t last = 2 * (widths.size() - 1);
  for (std::size_t c = 0; c + 1 < widths.size(); ++c)
    last += widths[c];
  for (const auto& row : rows_) {
    const std::string whole = line([&](std::size_t c) { return row[c].text; });
    result += row.back().value ? whole : fitted(whole, row.back().text, last);
    result += '\n';
  }
  return result;
}

nlohmann::json Table::json() const {
  auto result = nlohmann::json::array();
  for (const auto& row : rows_) {
    auto object = nlohmann::json::object();
    for (std::size_t c = 0; c < row.size(); ++c) {
      const auto& cell = row[c];
      if (!cell.value) {
        object[keys_[c]] = cell.text;
      } else if (std::isfinite(*cell.value)) {
        object[keys_[c]] = *cell.value;
      } else {
        object[keys_[c]] = nullptr;
      }
    }
    result.push_back(std::move(object));
  }
  return result;
}

}  // namespace carlo
