#pragma once

#include "course/report/page.h"

#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace lab06 {

/// Stretches of the x axis and of the y axis.
struct View {
  double first = 0, last = 1, top = 1, bottom = 0;
  carlo::Scale scale = carlo::Scale::linear;  ///< of the x axis
};

/// A line of a graph, in the colour of a class of the page, c1, c2, ...
struct Line {
  std::string name, style;
  std::vector<carlo::Point> points;
};

/// The graph of a function over a view.
inline Line line(std::string name, std::string style, const View& view,
                 const std::function<double(double)>& f) {
  return {std::move(name), std::move(style), carlo::graph(f, {view.first, view.last})};
}

/// One tile: lines with a legend; `marks` are positions on the x axis, such as samples.
std::string graph_picture(std::string_view title, std::string_view note, const View& view,
                          const std::vector<Line>& lines, const std::vector<double>& marks = {});

/// The figure with a slider for the exponent of p, with f = 5 x^4.
std::string family_slider();

}  // namespace lab06
