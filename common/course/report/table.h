#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace carlo {

/// One cell: its text for people and, for numbers, the full-precision value for machines. Numbers
/// are right-aligned, text left-aligned.
struct Cell {
  Cell(std::string words) : text(std::move(words)) {}
  Cell(const char* words) : text(words) {}
  Cell(double number);
  Cell(std::int64_t count);
  Cell(int count) : Cell(static_cast<std::int64_t>(count)) {}
  /// A number displayed as `shown`.
  Cell(std::string shown, double number) : text(std::move(shown)), value(number) {}

  std::string text;
  std::optional<double> value;
};

/// Makes a cell of a number with so many significant digits.
Cell number_cell(double value, int digits = 3);
/// Makes a cell of a share, shown in per cent.
Cell percent_cell(double share, int digits = 3);
/// Makes a cell of a duration in seconds, shown in a suitable unit.
Cell seconds_cell(double seconds);
/// Makes a cell of a measured value with the half width of its interval; machines get only the
/// value.
Cell interval_cell(double value, double half_width);
/// Makes a cell without content.
Cell empty_cell();

/// A small table, the same on the console, on a page and in a JSON file.
class Table {
 public:
  /// `keys`, if given, name the columns in JSON; otherwise the titles do.
  explicit Table(std::vector<std::string> titles, std::vector<std::string> keys = {});

  /// Adds a row. Throws Error unless it has as many cells as there are columns.
  void add_row(std::vector<Cell> cells);

  const std::vector<std::string>& titles() const { return titles_; }
  const std::vector<std::string>& keys() const { return keys_; }
  const std::vector<std::vector<Cell>>& rows() const { return rows_; }

  /// Returns whether the column holds numbers (and is right-aligned).
  bool numeric(std::size_t column) const;

  /// Returns aligned columns, each line ending in '\n', no wider than `columns` (0: any width):
  /// remaining columns go into a block below, after the leading columns that name the rows. Titles
  /// are bold where stdout shows colours; plain text when piped.
  std::string text(int columns) const;
  /// The same for the terminal that stdout is, or for any width.
  std::string text() const;

  /// The same for a page; wide tables scroll.
  std::string html(std::string_view caption = "") const;

 private:
  std::vector<std::string> titles_;
  std::vector<std::string> keys_;
  std::vector<std::vector<Cell>> rows_;
};

}  // namespace carlo
