#pragma once

#include "report/page.h"

#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace lab06 {

// Pictures as HTML for a page: SVG in the page's own colours, as wide as the page lets them be.

/// The frame for tiles that stand side by side where the screen is wide enough, each at least
/// `narrowest` rem wide.
std::string tiles(const std::vector<std::string>& pictures, int narrowest);

/// Stretches of the x axis and of the y axis. What stands at the two ends of the x axis may be
/// given; else it is their numbers.
struct View {
  double first = 0, last = 1, top = 1, bottom = 0;
  std::string first_text = {}, last_text = {};
};

/// A line of a graph, in one of the page's series colours 1, 2, ...
struct Line {
  std::string name;
  int colour = 1;
  std::vector<carlo::Point> points;
};

/// The graph of a function over a view.
Line line(std::string name, int colour, const View& view, const std::function<double(double)>& f);

/// One tile: lines with a legend, interrupted where they leave the view; `marks` are places on the
/// x axis, such as samples.
std::string graph_picture(std::string_view title, std::string_view note, const View& view,
                          const std::vector<Line>& lines, const std::vector<double>& marks = {});

/// The figure in which the exponent of p is moved by a slider, with f = 5 x^4; and its script.
std::string family_html();
std::string family_script();

}  // namespace lab06
