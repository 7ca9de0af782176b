#pragma once

#include "course/verdict/figure.h"

#include <functional>
#include <span>
#include <string>

namespace carlo::grader {

// What checks name as the grader's.
using carlo::Figure;

// Figures made from what a comparison compared. All keep to the sizes of figure.h whatever they are
// given; values that are no numbers are left out and counted in the note.

/// The values beside theory's mean: a histogram where it shows the mean's distance, else the mean
/// of the first n values against n, with three standard errors (theory's) to either side.
Figure mean_figure(std::span<const double> values, double mean, double sd);

/// The values' histogram, with one standard deviation to both sides of the theoretical mean: theirs
/// and theory's.
Figure spread_figure(std::span<const double> values, double mean, double sd);

/// The share of the values at or below x against that of the uniform distribution on [lower,
/// upper]. `sorted`, all finite, not empty.
Figure uniform_figure(std::span<const double> sorted, double lower, double upper);

/// The horizontal axis of counted cells: what it shows and where the first begins and the last
/// ends.
struct CellAxis {
  std::string label = "cell";
  double first = 0;
  double last = 0;  ///< first: the cells' numbers, from 1
};

/// Counts in cells of equal width beside what is expected in each, give or take three standard
/// deviations. More cells than fit are added up by neighbours.
Figure counts_figure(const CellAxis& axis, std::span<const double> counts,
                     std::span<const double> expected);

/// Counts in rows of `columns` cells, by how many standard deviations each is off. Sides that are
/// too long are added up by neighbours.
Figure cells_figure(const std::string& column_label, const std::string& row_label,
                    std::size_t columns, std::span<const double> counts,
                    std::span<const double> expected);

/// The same for values that are no counts, tiles of an image for one: sd is the standard deviation
/// of measured - expected.
Figure tiles_figure(std::size_t columns, std::span<const double> measured,
                    std::span<const double> expected, std::span<const double> sd);

/// Where values were asked for, in words.
using PlaceName = std::function<std::string(std::size_t index)>;

/// The first values that differ, by `wrong(index)`: place, measured, expected and their ratio; of
/// neighbours at one place the first. When all that differ have one ratio, the note says so.
Figure differences_listing(const std::string& place_title, const PlaceName& place,
                           std::span<const double> measured, std::span<const double> expected,
                           const std::function<bool(std::size_t)>& wrong);

/// A function's values at `at` beside the right ones: a curve where the eye sees the difference,
/// else the listing.
Figure curve_figure(const std::string& x_label, std::span<const double> at,
                    std::span<const double> measured, std::span<const double> expected,
                    const std::function<bool(std::size_t)>& wrong);

}  // namespace carlo::grader
