#pragma once

#include "course/report/plot.h"
#include "stats/fit.h"

#include <cstddef>
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

/// Returns a slider over `content` (trusted HTML), for Page::raw_html(): `words` has the text for
/// each of its positions; it begins at `start`.
std::string slider_html(std::string_view label, const std::vector<std::string>& words,
                        std::size_t start, std::string_view content);

/// Returns the part of the content's drawings that is shown only at the positions from `first` to
/// `last`.
std::string shown_at(std::size_t first, std::size_t last, std::string_view svg);

/// Returns the script that moves all sliders of a page, for Page::script(), once.
std::string_view slider_script();

}  // namespace carlo
