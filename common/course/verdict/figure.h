#pragma once

#include <cstddef>
#include <limits>
#include <string>
#include <variant>
#include <vector>

namespace carlo {

// The figures of a verdict. Plain data: the judge makes it, JSON carries it, a page draws it.

/// Limits on a figure's size. Writers keep to them, readers reject more.
constexpr std::size_t most_bins = 64;
constexpr std::size_t most_points = 128;
constexpr std::size_t most_cells_a_side = 32;
constexpr std::size_t most_rows = 12;
constexpr std::size_t most_columns = 6;
constexpr std::size_t most_marks = 6;

/// A named place on the horizontal axis.
struct Mark {
  enum class Role { measured, expected, suspect };
  double at = 0;
  std::string label;
  Role role = Role::measured;
};

/// Counts in equal bins of [first, last], next to the expected count in each, plus or minus `band`;
/// both may be empty.
struct HistogramFigure {
  std::string x_label;
  double first = 0, last = 1;
  std::vector<double> measured, expected, band;
  std::vector<Mark> marks;
};

/// Values at places x, each with the half width of its error bar (0: none) and the expected value
/// there (NaN: none). `joined`: a curve rather than single measurements.
struct PointsFigure {
  struct Point {
    double x = 0, measured = 0, half_width = 0;
    double expected = std::numeric_limits<double>::quiet_NaN();
  };
  std::string x_label, y_label;
  bool log_x = false, joined = false;
  std::vector<Point> points;
};

/// Values in cells or tiles, row by row, next to the expected value of each and its standard
/// deviation; drawn by how many standard deviations a cell is off.
struct GridFigure {
  std::string column_label, row_label;
  std::size_t columns = 0;
  std::vector<double> measured, expected, sd;
};

/// A few rows of text.
struct ListingFigure {
  std::vector<std::string> titles;
  std::vector<std::vector<std::string>> rows;
};

struct Figure {
  std::string title;
  std::string note;  ///< one line under it; may be empty
  std::variant<HistogramFigure, PointsFigure, GridFigure, ListingFigure> data;
};

}  // namespace carlo
