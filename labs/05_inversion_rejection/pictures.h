#pragma once

#include "inversion_rejection.h"

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace lab05 {

// Pictures as HTML for a page: SVG in the page's own colours, as wide as the page allows.

/// A stretch of the x axis, and the y axis from 0 to `top`.
struct View {
  double first = 0, last = 1, top = 1;
};

/// One tile: darts below the graph of f in one colour, those above it in another.
std::string darts_picture(std::string_view title, std::string_view note, const View& view,
                          const Function& f, std::span<const Point> darts);

/// One tile: points of the square [-1, 1]^2 around the unit disc; those outside are drawn as
/// rejected.
std::string disc_picture(std::string_view title, std::string_view note,
                         std::span<const Point> points);

/// One tile: a width x height image in shades, row 0 at the top; and points of the unit square over
/// it.
std::string image_picture(std::string_view title, std::string_view note,
                          std::span<const double> weights, std::size_t width,
                          std::span<const Point> points);

/// A density and its samples x at u = 0, 1/inverse_steps, ..., and nearly 1.
struct Inverse {
  std::string name;
  View view;
  Function pdf;
  std::vector<double> x;
};
constexpr std::size_t inverse_steps = 50;

/// Inversion by hand: a slider for u; its x on each inverse CDF, and u as the area under the
/// density.
std::string inverse_slider(const std::vector<Inverse>& curves);

}  // namespace lab05
