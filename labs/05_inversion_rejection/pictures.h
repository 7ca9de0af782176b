#pragma once

#include "inversion_rejection.h"

#include <nlohmann/json_fwd.hpp>

#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace lab05 {

// Pictures as HTML for a page: SVG in the page's own colours, as wide as the page lets them be.

/// The frame for tiles that stand side by side where the screen is wide enough.
std::string tiles(const std::vector<std::string>& pictures);

/// A stretch of the x axis, and the y axis from 0 to `top`.
struct View {
  double first = 0, last = 1, top = 1;
};

/// One tile: bars of equal width from view.first to view.last, heights as densities, under the
/// density's line.
std::string histogram_picture(std::string_view title, std::string_view note, const View& view,
                              std::span<const double> bars, const Function& pdf);

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

/// Inversion by hand: a slider for u, the inverse CDF and the area under the density. `curves` is a
/// list of {"name", "x": [sample at u = 0, 1/200 ... ], "pdf": [[x, density] ...]}.
std::string inverse_html();
std::string inverse_script(const nlohmann::json& curves);

}  // namespace lab05
