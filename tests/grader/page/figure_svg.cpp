#include "grader/page/figure_svg.h"

#include "grader/page/plot.h"
#include "grader/page/text.h"
#include "report/format.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace carlo::grader {
namespace {

double number(std::size_t n) {
  return static_cast<double>(n);
}

// Tables ---------------------------------------------------------------------------------------

using Row = std::vector<std::string>;

std::string table(const Row& titles, const std::vector<Row>& rows) {
  std::string out =
      "<div class=\"scroll\" tabindex=\"0\" role=\"group\" "
      "aria-label=\"Table\"><table>\n<thead><tr>";
  for (const std::string& title : titles)
    out += fmt::format("<th class=\"number\">{}</th>", html(title));
  out += "</tr></thead>\n<tbody>\n";
  for (const Row& row : rows) {
    out += "<tr>";
    for (const std::string& cell : row)
      out += fmt::format("<td class=\"number\">{}</td>", html(cell));
    out += "</tr>\n";
  }
  return out + "</tbody></table></div>\n";
}

std::string folded(const std::string& summary, const std::string& content) {
  return fmt::format("<details><summary>{}</summary>{}</details>\n", html(summary), content);
}

std::string key(const std::vector<std::pair<const char*, const char*>>& entries) {
  std::string out = "<p class=\"key\">";
  for (const auto& [style, words] : entries)
    out += fmt::format("<span><i class=\"{}\"></i>{}</span>", style, html(words));
  return out + "</p>\n";
}

/// The finite numbers' range with some air; 0 to 1 when there are none.
Interval range_of(const std::vector<double>& values) {
  Interval range{HUGE_VAL, -HUGE_VAL};
  for (const double v : values) {
    if (!std::isfinite(v)) continue;
    range.first = std::min(range.first, v);
    range.last = std::max(range.last, v);
  }
  if (!(range.first <= range.last)) return {};
  double air = 0.06 * (range.last - range.first);
  if (!(air > 0) || !std::isfinite(air)) air = range.last == 0 ? 1 : 0.1 * std::abs(range.last);
  return {range.first - air, range.last + air};
}

// Histogram ------------------------------------------------------------------------------------

const char* style_of(Mark::Role role) {
  if (role == Mark::Role::expected) return "e mark";
  return role == Mark::Role::suspect ? "s mark" : "m-line mark";
}

std::string marks_html(const HistogramFigure& h) {
  std::string out;
  for (const Mark& mark : h.marks) {
    if (mark.label.empty()) continue;
    const char* style = mark.role == Mark::Role::expected  ? "e"
                        : mark.role == Mark::Role::suspect ? "s"
                                                           : "m-line";
    out += fmt::format("<span><i class=\"{}\"></i>{}</span>", style, html(mark.label));
  }
  return out.empty() ? "" : "<p class=\"key\">" + out + "</p>\n";
}

/// The expected counts as steps, and their band.
void draw_expected(Plot& plot, const HistogramFigure& h, double width) {
  std::string steps, upper, lower;
  for (std::size_t i = 0; i < h.expected.size(); ++i) {
    const double from = plot.x(h.first + number(i) * width);
    const double to = plot.x(h.first + number(i + 1) * width);
    const double e = h.expected[i], b = h.band.empty() ? 0 : h.band[i];
    steps += path_step(i == 0 ? 'M' : 'L', from, plot.y(e)) + path_step('L', to, plot.y(e));
    upper += path_step(i == 0 ? 'M' : 'L', from, plot.y(e + b)) + path_step('L', to, plot.y(e + b));
    lower.insert(0, path_step('L', to, plot.y(e - b)) + path_step('L', from, plot.y(e - b)));
  }
  if (!h.band.empty()) plot.line(upper + lower + "Z", "band");
  if (!h.expected.empty()) plot.line(steps, "e");
}

std::string draw(const HistogramFigure& h) {
  const double width = (h.last - h.first) / number(h.measured.size());
  double most = 0;
  for (std::size_t i = 0; i < h.measured.size(); ++i) {
    most = std::max(most, h.measured[i]);
    if (!h.expected.empty())
      most = std::max(most, h.expected[i] + (h.band.empty() ? 0 : h.band[i]));
  }
  if (!(most > 0) || !std::isfinite(most)) most = 1;
  Plot plot({h.first, h.last}, {0, 1.06 * most}, h.x_label, "");
  std::vector<Row> rows;
  for (std::size_t i = 0; i < h.measured.size(); ++i) {
    const double from = h.first + number(i) * width;
    Row row{number_text(from), number_text(from + width), number_text(h.measured[i], 6)};
    if (!h.expected.empty()) row.push_back(number_text(h.expected[i], 6));
    plot.bar(from, from + width, std::isfinite(h.measured[i]) ? h.measured[i] : 0,
             fmt::format("{} to {}: {}{}", row[0], row[1], row[2],
                         h.expected.empty() ? "" : ", expected " + row[3]));
    rows.push_back(std::move(row));
  }
  draw_expected(plot, h, width);
  for (const Mark& mark : h.marks) {
    if (!(mark.at >= h.first && mark.at <= h.last)) continue;
    plot.line(fmt::format("M{:.1f} {:.0f}V{:.0f}", plot.x(mark.at), Plot::top, Plot::bottom),
              style_of(mark.role));
  }
  Row titles{"from", "to", "measured"};
  if (!h.expected.empty()) titles.emplace_back("expected");
  std::string out = plot.svg(
      fmt::format("Histogram of {} bins. The numbers are in the table below.", h.measured.size()));
  if (!h.expected.empty()) out += key({{"m", "measured"}, {"e", "expected"}});
  return out + marks_html(h) + folded("The numbers", table(titles, rows));
}

// Points ---------------------------------------------------------------------------------------

std::string draw(const PointsFigure& p) {
  std::vector<double> xs, ys;
  for (const PointsFigure::Point& point : p.points) {
    if (!p.log_x || point.x > 0) xs.push_back(point.x);
    ys.insert(ys.end(), {point.measured - point.half_width, point.measured + point.half_width,
                         point.expected});
  }
  Interval across = range_of(xs);
  if (p.log_x && !xs.empty()) {
    const auto [low, high] = std::minmax_element(xs.begin(), xs.end());
    across = {*low / 1.3, *high * 1.3, true};
  }
  Plot plot(across, range_of(ys), p.x_label, p.y_label);
  std::string expected, measured, bars, dots;
  std::vector<Row> rows;
  bool had_bars = false, gap = true, measured_gap = true;
  for (const PointsFigure::Point& point : p.points) {
    rows.push_back({number_text(point.x, 6), number_text(point.measured, 6),
                    number_text(point.half_width, 2), number_text(point.expected, 6)});
    const double x = plot.x(point.x);
    if (std::isfinite(point.expected)) {
      expected += path_step(gap ? 'M' : 'L', x, plot.y(point.expected));
      gap = false;
    } else {
      gap = true;
    }
    if (!std::isfinite(point.measured)) {
      measured_gap = true;
      continue;
    }
    const double y = plot.y(point.measured);
    measured += path_step(measured_gap ? 'M' : 'L', x, y);
    measured_gap = false;
    dots += fmt::format(
        "<circle class=\"m-dot\" cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{}\"><title>{}: {}, expected "
        "{}</title></circle>\n",
        x, y, p.points.size() > 40 ? "1.9" : "3", html(rows.back()[0]), html(rows.back()[1]),
        html(rows.back()[3]));
    if (point.half_width > 0 && std::isfinite(point.half_width)) {
      had_bars = true;
      bars += path_step('M', x, plot.y(point.measured - point.half_width)) +
              path_step('L', x, plot.y(point.measured + point.half_width));
    }
  }
  if (had_bars) plot.line(bars, "m-line");
  if (p.joined) {
    plot.line(measured, "m-line");
  } else {
    plot.add(dots);
  }
  plot.line(expected, "e");
  return plot.svg(fmt::format("{} against {}, {} points. The numbers are in the table below.",
                              p.y_label, p.x_label, p.points.size())) +
         key({{p.joined ? "m-line" : "m-dot", "measured"}, {"e", "expected"}}) +
         folded("The numbers", table({p.x_label, "measured", "give or take", "expected"}, rows));
}

// Grid -----------------------------------------------------------------------------------------

double deviation(const GridFigure& g, std::size_t i) {
  return (g.measured[i] - g.expected[i]) / g.sd[i];
}

/// Nothing up to one standard deviation, full colour from nine on. A cell that is no number is
/// ink.
std::string fill(double z) {
  if (std::isnan(z)) return "class=\"bad\"";
  const double strength = std::clamp((std::abs(z) - 1) / 8, 0.0, 1.0);
  return fmt::format("class=\"{}\" fill-opacity=\"{:.2f}\"", z > 0 ? "more" : "less", strength);
}

/// The cells that are furthest off.
std::string worst_cells(const GridFigure& g) {
  std::vector<std::size_t> order(g.measured.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto size = [&](std::size_t i) {
    const double z = std::abs(deviation(g, i));
    return std::isnan(z) ? HUGE_VAL : z;
  };
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return size(a) > size(b); });
  std::vector<Row> rows;
  for (std::size_t k = 0; k < std::min(order.size(), most_rows); ++k) {
    const std::size_t i = order[k];
    rows.push_back({fmt::format("{}", i % g.columns + 1), fmt::format("{}", i / g.columns + 1),
                    number_text(g.measured[i], 6), number_text(g.expected[i], 6),
                    fmt::format("{:+.1f}", deviation(g, i))});
  }
  return folded("The cells that are furthest off",
                table({"column", "row", "measured", "expected", "z"}, rows));
}

std::string draw(const GridFigure& g) {
  const std::size_t rows = g.measured.size() / g.columns;
  constexpr double left = 26, across = 324;
  const double width = across / number(g.columns);
  const double height = std::min(width, 260 / number(rows));
  const double bottom = 4 + height * number(rows);
  std::string out = fmt::format(
      "<svg viewBox=\"0 0 360 {:.0f}\" role=\"img\" aria-label=\"{} columns and {} rows of cells. "
      "Those furthest off are in the table below.\">\n",
      bottom + 24, g.columns, rows);
  for (std::size_t i = 0; i < g.measured.size(); ++i) {
    const std::size_t column = i % g.columns, row = i / g.columns;
    const double z = deviation(g, i);
    out += fmt::format(
        "<rect {} x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\"><title>column {}, "
        "row "
        "{}: {}, expected {}, z = {:+.1f}</title></rect>\n",
        fill(z), left + width * number(column), 4 + height * number(row), width, height, column + 1,
        row + 1, number_text(g.measured[i]), number_text(g.expected[i]), z);
  }
  out += fmt::format(
      "<path class=\"axis\" d=\"M{0:.0f} 4H{1:.0f}V{2:.1f}H{0:.0f}Z\"/>\n"
      "<text class=\"label\" x=\"{3:.0f}\" y=\"{4:.1f}\" text-anchor=\"middle\">{5}</text>\n"
      "<text class=\"label\" transform=\"translate(16 {6:.1f}) rotate(-90)\" "
      "text-anchor=\"middle\">{7}</text>\n</svg>\n",
      left, left + across, bottom, left + across / 2, bottom + 17, html(g.column_label),
      (4 + bottom) / 2, html(g.row_label));
  return out + key({{"less", "less than expected"}, {"more", "more than expected"}}) +
         worst_cells(g);
}

// Listing --------------------------------------------------------------------------------------

std::string draw(const ListingFigure& l) {
  return table(l.titles, l.rows);
}

}  // namespace

std::string figure_html(const Figure& figure) {
  std::string out = "<figure>";
  if (!figure.title.empty()) {
    const std::string note =
        figure.note.empty() ? "" : fmt::format("<span>{}</span>", html(figure.note));
    out += fmt::format("<figcaption>{}{}</figcaption>\n", html(figure.title), note);
  }
  return out + std::visit([](const auto& data) { return draw(data); }, figure.data) + "</figure>\n";
}

}  // namespace carlo::grader
