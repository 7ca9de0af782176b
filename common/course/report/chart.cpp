#include "course/report/chart.h"

#include "course/report/format.h"
#include "course/report/html.h"
#include "course/report/table.h"
#include "course/report/web_files.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace carlo {
namespace {

constexpr std::size_t colours = 8;

std::string slope_text(const PowerFit& fit) {
  return interval_text(fit.slope, fit.slope_half_width);
}

/// Returns the chart as numbers, for readers who cannot see it.
std::string data_html(const Chart& chart) {
  Table table({"series", chart.x.label, chart.y.label});
  for (const Series& series : chart.series) {
    for (const Point& p : series.points)
      table.add_row({series.name, Cell(chart.x.text(p.x), p.x), Cell(chart.y.text(p.y), p.y)});
  }
  return "<details><summary>The numbers</summary>" + table.html() + "</details>\n";
}

std::string description(const Chart& chart) {
  std::string text =
      fmt::format("Chart: {}. {} against {}.", chart.title, chart.y.label, chart.x.label);
  for (const Series& series : chart.series) {
    text += fmt::format(" {}: {} points", series.name, series.points.size());
    if (series.fit) text += ", slope " + slope_text(*series.fit);
    text += '.';
  }
  return text + " All numbers are in the table below.";
}

std::string legend(const Chart& chart) {
  std::string html = "<div class=\"legend\">";
  for (std::size_t i = 0; i < chart.series.size(); ++i) {
    const Series& series = chart.series[i];
    std::string slope = series.fit ? slope_text(*series.fit) : "";
    if (slope.starts_with('-')) slope.replace(0, 1, "−");
    html += fmt::format(
        "<label title=\"Show or hide\"><input type=\"checkbox\" class=\"sr-only\" checked>"
        "<i class=\"c{}\" aria-hidden=\"true\">{}</i>{}{}</label>",
        i % colours + 1, sign_of_series(i), html_typeset(series.name),
        slope.empty() ? "" : fmt::format("<small> slope {}</small>", slope));
  }
  return html + "</div>\n";
}

/// Draws the fitted line from the first point to the last, and its confidence band.
void draw_fit(Plot& plot, const Series& series) {
  const auto [first, last] =
      std::minmax_element(series.points.begin(), series.points.end(),
                          [](const Point& a, const Point& b) { return a.x < b.x; });
  std::vector<Point> line, upper, lower;
  constexpr int steps = 24;
  for (int i = 0; i <= steps; ++i) {
    const double x = first->x * std::pow(last->x / first->x, static_cast<double>(i) / steps);
    const double y = series.fit->at(x), factor = series.fit->band_factor(x);
    line.push_back({x, y});
    upper.push_back({x, y * factor});
    lower.push_back({x, y / factor});
  }
  plot.band("", upper, lower);
  plot.line("dashed", line);
}

void draw(Plot& plot, const Chart& chart, std::size_t index) {
  const Series& series = chart.series[index];
  plot.add(fmt::format("<g class=\"s{} c{}\">\n", index + 1, index % colours + 1));
  if (!series.fit) {
    plot.line("", series.points);
  } else if (!series.points.empty()) {
    draw_fit(plot, series);
  }
  for (const Point& p : series.points) {
    plot.mark("", index, p,
              fmt::format("{}\n{}: {}\n{}: {}", series.name, chart.x.label, chart.x.text(p.x),
                          chart.y.label, chart.y.text(p.y)));
  }
  plot.add("</g>\n");
}

std::string drawing(const Chart& chart) {
  std::vector<double> xs, ys;
  for (const Series& series : chart.series) {
    for (const Point& p : series.points) {
      if (!chart.x.can_show(p.x) || !chart.y.can_show(p.y)) continue;
      xs.push_back(p.x);
      ys.push_back(p.y);
    }
  }
  Plot plot(chart.x, round_stretch(chart.x, xs), chart.y, round_stretch(chart.y, ys), {400, 280});
  for (std::size_t i = 0; i < chart.series.size(); ++i)
    draw(plot, chart, i);
  return plot.svg(description(chart));
}

}  // namespace

std::string caption_html(std::string_view title, std::string_view note) {
  return fmt::format("<figcaption>{}{}</figcaption>\n", html_typeset(title),
                     note.empty() ? "" : fmt::format("<span>{}</span>", html_typeset(note)));
}

std::string legend_html(std::span<const Key> keys) {
  std::string html = "<div class=\"legend\">";
  for (const Key& key : keys)
    html += fmt::format("<span><i class=\"{}\">{}</i>{}</span>", key.style, key.sign,
                        html_typeset(key.words));
  return html + "</div>\n";
}

std::string chart_html(const Chart& chart) {
  return fmt::format("<figure>{}{}{}{}</figure>\n", caption_html(chart.title, chart.note),
                     legend(chart), drawing(chart), data_html(chart));
}

std::string slider_html(std::string_view label, const std::vector<std::string>& words,
                        std::size_t start, std::string_view content) {
  std::string html = fmt::format(
      "<div class=\"slider\"><label>{} <input type=\"range\" min=\"0\" max=\"{}\" "
      "value=\"{}\"></label>",
      html_escaped(label), words.size() - 1, start);
  for (std::size_t i = 0; i < words.size(); ++i) {
    html += fmt::format("<output data-first=\"{0}\" data-last=\"{0}\"{1}>{2}</output>", i,
                        i == start ? "" : " style=\"display: none\"", html_typeset(words[i]));
  }
  return fmt::format("{}\n{}</div>\n", html, content);
}

std::string shown_at(std::size_t first, std::size_t last, std::string_view svg) {
  return fmt::format("<g data-first=\"{}\" data-last=\"{}\">{}</g>\n", first, last, svg);
}

std::string_view slider_script() {
  return web::slider_js();
}

}  // namespace carlo
