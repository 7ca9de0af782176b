#pragma once

#include "course/report/plot.h"
#include "stats/fit.h"

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace carlo {

/// One set of points in its colour and shape. With a fit, the fitted line and its confidence band
/// are drawn and the legend shows the slope; without one, the points are joined.
struct Series {
  std::string name;
  std::vector<Point> points;
  std::optional<PowerFit> fit = std::nullopt;
};

/// Points that an axis cannot show (not finite, or <= 0 on a logarithmic one) are left out of the
/// drawing; the table under the chart lists them all.
struct Chart {
  std::string title;
  std::string note;  ///< one line under the title; may be empty
  Axis x, y;
  std::vector<Series> series;
};

/// Returns a figure's title and the line under it, which may be empty.
std::string caption_html(std::string_view title, std::string_view note);

/// What a colour in a drawing means: its class, a sign in that colour, and a description.
struct Key {
  std::string_view style, sign;
  std::string words;
};
std::string legend_html(std::span<const Key> keys);

/// Returns the figure: title, legend, drawing, and all numbers in a folded table. Names in the
/// legend show and hide their series.
std::string chart_html(const Chart& chart);

}  // namespace carlo
