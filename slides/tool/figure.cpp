#include "tool/figure.h"

#include "course/json/json_fields.h"
#include "course/report/html.h"
#include "course/report/plot.h"
#include "support/error.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <vector>

namespace carlo {
namespace {

struct AxisOfFigure {
  std::string label, unit;
  bool log = false;
  std::vector<double> range;  ///< first and last; empty: determined by the values
};

struct SeriesOfFigure {
  std::string name;
  std::vector<double> x, y;
  bool guide = false;                   ///< a dashed line without measurements
  std::optional<unsigned long> colour;  ///< that of the series of this number; else its own
};

/// One bar, with its value as text after it.
struct Row {
  std::string name, words;
  double value = 0;
  unsigned long series = 0;  ///< determines the colour
};

struct Figure {
  std::string kind;  ///< "lines" with marks, "functions" without, "points" or "bars"
  std::string description;
  double width = 0, height = 0;  ///< in units of Size
  bool square = false;
  AxisOfFigure x, y;
  std::vector<SeriesOfFigure> series;
  std::vector<Row> rows;
};

void fields(JsonFields& json, AxisOfFigure& axis) {
  json("label", axis.label);
  json("unit", axis.unit);
  json("log", axis.log);
  json("range", axis.range);
}

void fields(JsonFields& json, SeriesOfFigure& series) {
  json("name", series.name);
  json("x", series.x);
  json("y", series.y);
  json("guide", series.guide);
  json("colour", series.colour);
}

void fields(JsonFields& json, Row& row) {
  json("name", row.name);
  json("words", row.words);
  json("value", row.value);
  json("series", row.series);
}

void fields(JsonFields& json, Figure& figure) {
  json("kind", figure.kind);
  json("description", figure.description);
  json("width", figure.width);
  json("height", figure.height);
  json("square", figure.square);
  json("x", figure.x);
  json("y", figure.y);
  json("series", figure.series);
  json("rows", figure.rows);
}

Axis axis_of(const AxisOfFigure& axis) {
  static const std::map<std::string, Unit> units = {{"number", Unit::number},
                                                    {"count", Unit::count},
                                                    {"seconds", Unit::seconds},
                                                    {"degrees", Unit::degrees}};
  const auto unit = units.find(axis.unit);
  if (unit == units.end()) throw Error("no axis counts in '{}'", axis.unit);
  return {axis.label, unit->second, axis.log ? Scale::log : Scale::linear};
}

std::string colour(std::size_t series) {
  return fmt::format("c{}", series % 8 + 1);
}

std::string colour_of(const Figure& figure, std::size_t index) {
  return colour(figure.series[index].colour.value_or(index));
}

/// A series' name to the right of the axes, beside its last point.
struct Name {
  std::size_t series;
  std::string text;
  double at;
};

/// Places the names so that they do not overlap and stay between `top` and `bottom`.
void add_names(Plot& plot, const Figure& figure, std::vector<Name> names, double left,
               double bottom) {
  constexpr double gap = 14;
  std::sort(names.begin(), names.end(), [](const Name& a, const Name& b) { return a.at < b.at; });
  for (std::size_t i = 1; i < names.size(); ++i)
    names[i].at = std::max(names[i].at, names[i - 1].at + gap);
  for (std::size_t i = names.size(); i-- > 0;) {
    names[i].at = std::min(names[i].at, bottom);
    bottom = names[i].at - gap;
    plot.add_around(fmt::format("<text class=\"name {}\" x=\"{:.1f}\" y=\"{:.1f}\">{}</text>\n",
                                colour_of(figure, names[i].series), left, names[i].at + 3.5,
                                html_escaped(names[i].text)));
  }
}

/// Returns the range of an axis: as requested, or that of all values.
Stretch stretch_of(const Figure& figure, const AxisOfFigure& axis,
                   std::vector<double> SeriesOfFigure::*values) {
  if (axis.range.size() == 2) return {axis.range[0], axis.range[1]};
  std::vector<double> all;
  for (const SeriesOfFigure& series : figure.series)
    all.insert(all.end(), (series.*values).begin(), (series.*values).end());
  return round_stretch(axis_of(axis), all);
}

void draw_series(Plot& plot, const Figure& figure, std::size_t index, bool crowded) {
  const SeriesOfFigure& series = figure.series[index];
  std::vector<Point> points;
  for (std::size_t i = 0; i < std::min(series.x.size(), series.y.size()); ++i)
    points.push_back({series.x[i], series.y[i]});
  if (figure.kind == "points")
    return plot.dots(colour_of(figure, index), points, crowded ? 2.6 : 4.2);
  plot.line(colour_of(figure, index) + (series.guide ? " dashed" : ""), points);
  if (figure.kind == "functions" || series.guide) return;
  for (const Point& point : points)
    plot.mark(colour_of(figure, index), index, point, "");
}

std::string plot_svg(const Figure& figure) {
  Size size{figure.width, figure.height};
  for (const SeriesOfFigure& series : figure.series)
    if (!series.name.empty()) size.right = std::max(size.right, text_width(series.name) + 8);
  const Axis x = axis_of(figure.x), y = axis_of(figure.y);
  const Stretch across = stretch_of(figure, figure.x, &SeriesOfFigure::x);
  const Stretch up = stretch_of(figure, figure.y, &SeriesOfFigure::y);
  if (figure.square) {
    const Plot wide(x, across, y, up, size);
    size.width -=
        (wide.x(across.last) - wide.x(across.first)) - (wide.y(up.first) - wide.y(up.last));
  }
  Plot plot(x, across, y, up, size);
  std::size_t points = 0;
  for (const SeriesOfFigure& series : figure.series)
    points += series.x.size();
  std::vector<Name> names;
  for (std::size_t i = 0; i < figure.series.size(); ++i) {
    draw_series(plot, figure, i, points > 300);
    const SeriesOfFigure& series = figure.series[i];
    if (series.name.empty()) continue;
    const double last = series.y.empty() ? plot.y(up.last) : plot.y(series.y.back());
    names.push_back({i, series.name, std::clamp(last, plot.y(up.last), plot.y(up.first))});
  }
  add_names(plot, figure, names, plot.x(across.last) + 7, plot.y(up.first));
  return plot.svg(figure.description);
}

/// Draws bars from left to right, one below the other, each between its name and its value.
std::string bars_svg(const Figure& figure) {
  const Axis axis = axis_of(figure.y);
  double left = 0, words = 0;
  std::vector<double> values;
  if (axis.scale == Scale::linear) values.push_back(0);
  for (const Row& row : figure.rows) {
    left = std::max(left, text_width(row.name) + 10);
    words = std::max(words, text_width(row.words) + 10);
    if (axis.can_show(row.value)) values.push_back(row.value);
  }
  if (values.empty()) throw Error("no bar has a value that can be shown");
  const auto ends = std::minmax_element(values.begin(), values.end());
  const double least = *ends.first, most = *ends.second;
  const double first = axis.scale == Scale::log ? std::log(least / 2) : least;
  const auto place = [&](double value) {
    const double last = axis.scale == Scale::log ? std::log(most) : most;
    const double at = axis.scale == Scale::log ? std::log(value) : value;
    return left + (at - first) / (last - first) * (figure.width - words - left);
  };
  const double base = axis.scale == Scale::log ? left : place(0);
  const double step = std::min(33.0, figure.height / static_cast<double>(figure.rows.size()));
  std::string svg = fmt::format(
      "<svg class=\"plot\" viewBox=\"0 0 {:.0f} {:.0f}\" role=\"img\" "
      "aria-label=\"{}\">\n",
      figure.width, figure.height, html_escaped(figure.description));
  double y = 0;
  for (const Row& row : figure.rows) {
    const double end = axis.can_show(row.value) ? place(row.value) : base;
    svg += fmt::format(
        "<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"end\">{}</text>\n"
        "<rect class=\"{}\" fill=\"currentColor\" x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\"/>\n"
        "<text x=\"{:.1f}\" y=\"{:.1f}\">{}</text>\n",
        left - 6, y + step / 2 + 3.5, html_escaped(row.name), colour(row.series),
        std::min(base, end), y + 0.15 * step, std::abs(end - base), 0.7 * step,
        std::max(base, end) + 6, y + step / 2 + 3.5, html_escaped(row.words));
    y += step;
  }
  return svg + "</svg>\n";
}

}  // namespace

std::string figure_svg(const std::string& json) {
  const auto figure = from_json_text<Figure>(json, "the plot");
  return figure.kind == "bars" ? bars_svg(figure) : plot_svg(figure);
}

}  // namespace carlo
