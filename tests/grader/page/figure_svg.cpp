#include "grader/page/figure_svg.h"

#include "course/report/chart.h"
#include "course/report/format.h"
#include "course/report/html.h"
#include "course/report/plot.h"
#include "course/report/table.h"
#include "grader/page/text.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace carlo::grader {
namespace {

double number(std::size_t n) {
  return static_cast<double>(n);
}

/// Formats a value of a figure to six digits.
Cell value_cell(double value) {
  return number_cell(value, 6);
}

std::string folded(const std::string& summary, const Table& table) {
  return fmt::format("<details><summary>{}</summary>{}</details>\n", html_escaped(summary),
                     table.html());
}

Axis linear(const std::string& label) {
  return {printable(label), Unit::number, Scale::linear};
}

// Histogram ------------------------------------------------------------------------------------

/// Measured is orange, expected blue, in every figure.
constexpr const char *measured = "c2", *expected = "c1";

const char* style_of(Mark::Role role) {
  if (role == Mark::Role::expected) return "c1 dashed";
  return role == Mark::Role::suspect ? "c7 dotted" : "c2";
}

const char* sign_of(Mark::Role role) {
  if (role == Mark::Role::expected) return "╍";
  return role == Mark::Role::suspect ? "┅" : "━";
}

/// Draws the expected counts as steps, and their band.
void draw_expected(Plot& plot, const HistogramFigure& h, double width) {
  std::vector<Point> steps, upper, lower;
  for (std::size_t i = 0; i < h.expected.size(); ++i) {
    const double e = h.expected[i], b = h.band.empty() ? 0 : h.band[i];
    for (const std::size_t edge : {i, i + 1}) {
      const double x = h.first + number(edge) * width;
      steps.push_back({x, e});
      upper.push_back({x, e + b});
      lower.push_back({x, e - b});
    }
  }
  if (!h.band.empty()) plot.band(expected, upper, lower);
  if (!h.expected.empty()) plot.line(expected, steps);
}

std::string draw(const HistogramFigure& h) {
  const double width = (h.last - h.first) / number(h.measured.size());
  std::vector<double> heights{0};
  heights.insert(heights.end(), h.measured.begin(), h.measured.end());
  for (std::size_t i = 0; i < h.expected.size(); ++i)
    heights.push_back(h.expected[i] + (h.band.empty() ? 0 : h.band[i]));
  const Axis x = linear(h.x_label), y = linear("");
  Plot plot(x, {h.first, h.last}, y, {0, round_stretch(y, heights).last});
  std::vector<std::string> titles{"from", "to", "measured"};
  std::vector<Key> keys;
  if (!h.expected.empty()) {
    titles.emplace_back("expected");
    keys = {{measured, "■", "measured"}, {expected, "━", "expected"}};
  }
  Table table(titles);
  for (std::size_t i = 0; i < h.measured.size(); ++i) {
    const double from = h.first + number(i) * width;
    std::vector<Cell> row{number_cell(from, 4), number_cell(from + width, 4),
                          value_cell(h.measured[i])};
    if (!h.expected.empty()) row.push_back(value_cell(h.expected[i]));
    plot.bar(measured, from, from + width, h.measured[i],
             fmt::format("{} to {}: {}{}", row[0].text, row[1].text, row[2].text,
                         h.expected.empty() ? "" : ", expected " + row[3].text));
    table.add_row(std::move(row));
  }
  draw_expected(plot, h, width);
  for (const Mark& mark : h.marks) {
    plot.vertical(style_of(mark.role), mark.at);
    if (mark.label.empty()) continue;
    keys.push_back({style_of(mark.role), sign_of(mark.role), printable(mark.label)});
  }
  return legend_html(keys) +
         plot.svg(fmt::format("Histogram of {} bins. The numbers are in the table below.",
                              h.measured.size())) +
         folded("The numbers", table);
}

// Points ---------------------------------------------------------------------------------------

std::string draw(const PointsFigure& p) {
  const Axis x{printable(p.x_label), Unit::number, p.log_x ? Scale::log : Scale::linear};
  const Axis y = linear(p.y_label);
  std::vector<double> xs, ys;
  std::vector<Point> measured_line, expected_line;
  Table table({x.label, "measured", "give or take", "expected"});
  for (const PointsFigure::Point& point : p.points) {
    xs.push_back(point.x);
    ys.insert(ys.end(), {point.measured - point.half_width, point.measured + point.half_width,
                         point.measured, point.expected});
    measured_line.push_back({point.x, point.measured});
    expected_line.push_back({point.x, point.expected});
    table.add_row({value_cell(point.x), value_cell(point.measured),
                   number_cell(point.half_width, 2), value_cell(point.expected)});
  }
  Plot plot(x, round_stretch(x, xs), y, round_stretch(y, ys));
  if (p.joined) plot.line(measured, measured_line);
  for (std::size_t i = 0; i < p.points.size(); ++i) {
    const PointsFigure::Point& point = p.points[i];
    if (point.half_width > 0) plot.error_bar(measured, measured_line[i], point.half_width);
    if (p.joined) continue;
    const std::vector<Cell>& row = table.rows()[i];
    plot.mark(measured, 0, measured_line[i],
              fmt::format("{}: {}, expected {}", row[0].text, row[1].text, row[3].text));
  }
  plot.line(expected, expected_line);
  const std::vector<Key> keys{{measured, p.joined ? "━" : "●", "measured"},
                              {expected, "━", "expected"}};
  return legend_html(keys) +
         plot.svg(fmt::format("{} against {}, {} points. The numbers are in the table below.",
                              y.label, x.label, p.points.size())) +
         folded("The numbers", table);
}

// Grid -----------------------------------------------------------------------------------------

double deviation(const GridFigure& g, std::size_t i) {
  return (g.measured[i] - g.expected[i]) / g.sd[i];
}

/// Transparent up to one standard deviation, full colour from nine on. A cell that is not a number
/// is ink.
std::string fill(double z) {
  if (std::isnan(z)) return "fill=\"currentColor\"";
  const double strength = std::clamp((std::abs(z) - 1) / 8, 0.0, 1.0);
  return fmt::format("class=\"{}\" fill=\"currentColor\" fill-opacity=\"{:.2f}\"",
                     z > 0 ? "c2" : "c1", strength);
}

/// Returns the cells that are furthest off.
std::string worst_cells(const GridFigure& g) {
  std::vector<std::size_t> order(g.measured.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto size = [&](std::size_t i) {
    const double z = std::abs(deviation(g, i));
    return std::isnan(z) ? HUGE_VAL : z;
  };
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return size(a) > size(b); });
  Table table({"column", "row", "measured", "expected", "z"});
  for (std::size_t k = 0; k < std::min(order.size(), most_rows); ++k) {
    const std::size_t i = order[k];
    table.add_row({value_cell(number(i % g.columns + 1)), value_cell(number(i / g.columns + 1)),
                   value_cell(g.measured[i]), value_cell(g.expected[i]),
                   Cell(fmt::format("{:+.1f}", deviation(g, i)), deviation(g, i))});
  }
  return folded("The cells that are furthest off", table);
}

std::string draw(const GridFigure& g) {
  const std::size_t rows = g.measured.size() / g.columns;
  constexpr double left = 26, across = 324;
  const double width = across / number(g.columns);
  const double height = std::min(width, 260 / number(rows));
  const double bottom = 4 + height * number(rows);
  std::string out = fmt::format(
      "<svg class=\"plot\" viewBox=\"0 0 360 {:.0f}\" role=\"img\" aria-label=\"{} columns and {} "
      "rows of cells. Those furthest off are in the table below.\">\n",
      bottom + 24, g.columns, rows);
  for (std::size_t i = 0; i < g.measured.size(); ++i) {
    const std::size_t column = i % g.columns, row = i / g.columns;
    const double z = deviation(g, i);
    out += fmt::format(
        "<rect {} x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\"><title>column {}, "
        "row {}: {}, expected {}, z = {:+.1f}</title></rect>\n",
        fill(z), left + width * number(column), 4 + height * number(row), width, height, column + 1,
        row + 1, number_text(g.measured[i]), number_text(g.expected[i]), z);
  }
  out += fmt::format(
      "<path class=\"axis\" d=\"M{0:.0f} 4H{1:.0f}V{2:.1f}H{0:.0f}Z\"/>\n"
      "<text x=\"{3:.0f}\" y=\"{4:.1f}\" text-anchor=\"middle\">{5}</text>\n"
      "<text transform=\"translate(16 {6:.1f}) rotate(-90)\" "
      "text-anchor=\"middle\">{7}</text>\n</svg>\n",
      left, left + across, bottom, left + across / 2, bottom + 17, html(g.column_label),
      (4 + bottom) / 2, html(g.row_label));
  const std::vector<Key> keys{{"c1", "■", "less than expected"}, {"c2", "■", "more than expected"}};
  return legend_html(keys) + out + worst_cells(g);
}

// Listing --------------------------------------------------------------------------------------

std::string draw(const ListingFigure& l) {
  const auto printable_all = [](std::vector<std::string> words) {
    for (std::string& word : words)
      word = printable(word);
    return words;
  };
  if (l.titles.empty()) return "";
  Table table(printable_all(l.titles));
  for (const std::vector<std::string>& row : l.rows) {
    const std::vector<std::string> words = printable_all(row);
    table.add_row({words.begin(), words.end()});
  }
  return table.html();
}

}  // namespace

std::string figure_html(const Figure& figure) {
  return fmt::format(
      "<figure>{}{}</figure>\n",
      figure.title.empty() ? "" : caption_html(printable(figure.title), printable(figure.note)),
      std::visit([](const auto& data) { return draw(data); }, figure.data));
}

}  // namespace carlo::grader
