#pragma once

#include "course/verdict/figure.h"

#include <functional>
#include <span>
#include <string>

namespace carlo::grader {

// Lets checks name it as the grader's.
using carlo::Figure;

// Makes figures from the values of a comparison. All keep to the size limits of figure.h whatever
// the arguments; values that are not numbers are left out and counted in the note.

/// Shows the values and theory's mean: as a histogram if it shows the mean's distance, else as the
/// mean of the first n values against n, with three standard errors (theory's) to either side.
Figure mean_figure(std::span<const double> values, double mean, double sd);

/// Shows the values' histogram, with one standard deviation to both sides of the theoretical mean:
/// the values' and theory's.
Figure spread_figure(std::span<const double> values, double mean, double sd);

/// Shows the share of the values at or below x against that of the uniform distribution on [lower,
/// upper]. `sorted` must be finite and not empty.
Figure uniform_figure(std::span<const double> sorted, double lower, double upper);

/// The horizontal axis of counted cells: its label, the start of the first cell and the end of the
/// last.
struct CellAxis {
  std::string label = "cell";
  double first = 0;
  double last = 0;  ///< equal to first: the cells' numbers, from 1
};

/// Shows counts in cells of equal width and the expected counts, plus or minus three standard
/// deviations. If there are too many cells, sums neighbours.
Figure counts_figure(const CellAxis& axis, std::span<const double> counts,
                     std::span<const double> expected);

/// Shows counts in rows of `columns` cells, by how many standard deviations each is off. Sums
/// neighbours if sides are too long.
Figure cells_figure(const std::string& column_label, const std::string& row_label,
                    std::size_t columns, std::span<const double> counts,
                    std::span<const double> expected);

/// The same for values that are not counts, such as tiles of an image: sd is the standard deviation
/// of measured - expected.
Figure tiles_figure(std::size_t columns, std::span<const double> measured,
                    std::span<const double> expected, std::span<const double> sd);

/// Describes the place of a value.
using PlaceName = std::function<std::string(std::size_t index)>;

/// Lists the first values for which `wrong(index)`: place, measured, expected and their ratio; only
/// the first of neighbours at one place. If all have one ratio, the note says so.
Figure differences_listing(const std::string& place_title, const PlaceName& place,
                           std::span<const double> measured, std::span<const double> expected,
                           const std::function<bool(std::size_t)>& wrong);

/// Shows a function's values at `at` and the right ones: a curve if the difference is visible, else
/// the listing.
Figure curve_figure(const std::string& x_label, std::span<const double> at,
                    std::span<const double> measured, std::span<const double> expected,
                    const std::function<bool(std::size_t)>& wrong);

}  // namespace carlo::grader
