#pragma once

#include <nlohmann/json_fwd.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace carlo {

/// One cell: its text for people and, for numbers, the value at full precision for machines.
/// Numbers stand right-aligned, words left-aligned.
struct Cell {
  Cell(std::string words) : text(std::move(words)) {}
  Cell(const char* words) : text(words) {}
  Cell(double number);
  Cell(std::int64_t count);
  Cell(int count) : Cell(static_cast<std::int64_t>(count)) {}
  /// A number that is shown as `shown`.
  Cell(std::string shown, double number) : text(std::move(shown)), value(number) {}

  std::string text;
  std::optional<double> value;
};

/// A number to so many significant digits.
Cell number_cell(double value, int digits = 3);
/// A share, shown in per cent.
Cell percent_cell(double share, int digits = 3);
/// A duration in seconds, shown with the unit that suits it.
Cell seconds_cell(double seconds);
/// A measured value with the half width of its interval; the value alone goes to machines.
Cell interval_cell(double value, double half_width);
/// A cell that has nothing to say.
Cell empty_cell();

/// A small table: one on the console, the same one on a page and in a JSON file.
class Table {
 public:
  /// `keys`, where given, name the columns in JSON; without them the titles do.
  explicit Table(std::vector<std::string> titles, std::vector<std::string> keys = {});

  /// One row; as many cells as columns, else Error.
  void add_row(std::vector<Cell> cells);

  const std::vector<std::string>& titles() const { return titles_; }
  const std::vector<std::vector<Cell>>& rows() const { return rows_; }

  /// Whether the column holds numbers (and is set to the right).
  bool numeric(std::size_t column) const;

  /// Aligned columns, each line ending in '\n', no wider than `columns` (0: any width): the columns
  /// that are left stand in a block below, behind those in front that name the rows. Titles are
  /// bold where stdout shows colours; nothing but plain text when piped.
  std::string text(int columns) const;
  /// For the terminal that stdout is, or any width.
  std::string text() const;

  /// The same for a page; wide ones can be scrolled.
  std::string html(std::string_view caption = "") const;

  /// An array with one object a row: numbers as numbers (null when not finite), words as strings.
  nlohmann::json json() const;

 private:
  std::vector<std::string> titles_;
  std::vector<std::string> keys_;
  std::vector<std::vector<Cell>> rows_;
};

}  // namespace carlo
