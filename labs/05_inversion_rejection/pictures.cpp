#include "pictures.h"

#include "report/format.h"
#include "report/page.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace lab05 {
namespace {

constexpr std::string_view style = R"(<style>
.tiles { display: grid; gap: 1.5rem; margin: 1.5rem 0;
         grid-template-columns: repeat(auto-fit, minmax(min(100%, var(--tile)), 1fr)); }
.tiles svg { display: block; width: 100%; height: auto; margin: auto 0; }
.tiles .axis { stroke: var(--soft); stroke-width: 1.5; fill: none; }
.tiles text { fill: var(--soft); font-size: 15px; }
.tiles .bars { fill: var(--series-1); fill-opacity: 0.35; stroke: var(--series-1); }
.tiles .line { fill: none; stroke: var(--series-2); stroke-width: 3; stroke-linejoin: round; }
.tiles .kept, .tiles .lost { fill: none; stroke-width: 4.5; stroke-linecap: round; }
.tiles .kept { stroke: var(--series-1); }
.tiles .lost { stroke: var(--series-2); opacity: 0.45; }
.tiles .dots { stroke: #00b2ff; stroke-width: 3.5; stroke-linecap: round; }
</style>
)";

constexpr double plot_width = 440, plot_height = 260;

std::string figure(std::string_view title, std::string_view note, std::string_view box,
                   const std::string& drawing) {
  return fmt::format(
      "<figure>\n<figcaption>{0}<span>{1}</span></figcaption>\n"
      "<svg viewBox=\"{2}\" role=\"img\" aria-label=\"{0}: {1}\">\n{3}</svg>\n</figure>\n",
      carlo::html_escaped(title), carlo::html_escaped(note), box, drawing);
}

/// Places of a view in a plot of 440 x 260, y upwards.
struct Frame {
  View view;
  double x(double value) const {
    return plot_width * (value - view.first) / (view.last - view.first);
  }
  double y(double value) const {
    return plot_height * (1 - std::clamp(value / view.top, -0.02, 1.05));
  }
};

std::string plot(std::string_view title, std::string_view note, const View& view,
                 const std::string& drawing) {
  const std::string axis = fmt::format(
      "<path class=\"axis\" d=\"M0 0V260H440\"/>\n"
      "<text y=\"280\">{}</text><text x=\"440\" y=\"280\" text-anchor=\"end\">{}</text>"
      "<text y=\"-6\">{}</text>\n",
      carlo::number_text(view.first, 3), carlo::number_text(view.last, 3),
      carlo::number_text(view.top, 3));
  return figure(title, note, "-4 -24 448 308", drawing + axis);
}

std::string graph(const Frame& frame, const Function& f) {
  constexpr int steps = 220;
  const double h = (frame.view.last - frame.view.first) / steps;
  std::string path;
  for (int i = 0; i < steps; ++i) {
    const double x = frame.view.first + (i + 0.5) * h;
    const double y = f(x);
    if (!std::isfinite(y)) continue;
    path += fmt::format("{}{:.1f} {:.1f}", path.empty() ? 'M' : 'L', frame.x(x), frame.y(y));
  }
  return fmt::format("<path class=\"line\" d=\"{}\"/>\n", path);
}

/// Many dots as one path: strokes of length 0 with round ends.
std::string dots(std::string_view kind, const std::vector<std::pair<double, double>>& places) {
  std::string path;
  for (const auto& [x, y] : places)
    path += fmt::format("M{:.1f} {:.1f}h0", x, y);
  return fmt::format("<path class=\"{}\" d=\"{}\"/>\n", kind, path);
}

}  // namespace

std::string tiles(const std::vector<std::string>& pictures) {
  // Four fit into one row of a wide screen, else three.
  std::string html =
      std::string(style) + fmt::format("<div class=\"tiles\" style=\"--tile: {}rem\">\n",
                                       pictures.size() == 4 ? 14 : 19);
  for (const std::string& picture : pictures)
    html += picture;
  return html + "</div>\n";
}

std::string histogram_picture(std::string_view title, std::string_view note, const View& view,
                              std::span<const double> bars, const Function& pdf) {
  const Frame frame{view};
  const double width = plot_width / static_cast<double>(bars.size());
  std::string path;
  for (std::size_t i = 0; i < bars.size(); ++i) {
    const double top = frame.y(bars[i]);
    path +=
        fmt::format("M{:.1f} 260V{:.1f}h{:.2f}V260", static_cast<double>(i) * width, top, width);
  }
  return plot(title, note, view,
              fmt::format("<path class=\"bars\" d=\"{}\"/>\n", path) + graph(frame, pdf));
}

std::string darts_picture(std::string_view title, std::string_view note, const View& view,
                          const Function& f, std::span<const Point> darts) {
  const Frame frame{view};
  std::vector<std::pair<double, double>> kept, lost;
  for (const Point& dart : darts) {
    (dart.y < f(dart.x) ? kept : lost).emplace_back(frame.x(dart.x), frame.y(dart.y));
  }
  return plot(title, note, view, dots("lost", lost) + dots("kept", kept) + graph(frame, f));
}

std::string disc_picture(std::string_view title, std::string_view note,
                         std::span<const Point> points) {
  std::vector<std::pair<double, double>> kept, lost;
  for (const Point& p : points) {
    auto& list = p.x * p.x + p.y * p.y <= 1 ? kept : lost;
    if (std::abs(p.x) <= 1 && std::abs(p.y) <= 1) list.emplace_back(200 * p.x, -200 * p.y);
  }
  return figure(title, note, "-204 -204 408 408",
                dots("lost", lost) + dots("kept", kept) +
                    "<circle class=\"axis\" r=\"200\"/>\n"
                    "<rect class=\"axis\" x=\"-200\" y=\"-200\" width=\"400\" height=\"400\"/>\n");
}

std::string image_picture(std::string_view title, std::string_view note,
                          std::span<const double> weights, std::size_t width,
                          std::span<const Point> points) {
  constexpr double shown_width = 640;
  const double cell = shown_width / static_cast<double>(width);
  const std::size_t rows = weights.size() / width;
  const double height = cell * static_cast<double>(rows);
  const double brightest = *std::max_element(weights.begin(), weights.end());
  std::string drawing;
  for (std::size_t k = 0; k < weights.size(); ++k) {
    // The cube root lets the dim parts be seen beside the brightest.
    const auto grey = static_cast<int>(std::lround(255 * std::cbrt(weights[k] / brightest)));
    const std::size_t column = k % width, row = k / width;
    drawing += fmt::format(
        "<path fill=\"#{0:02x}{0:02x}{0:02x}\" d=\"M{1:.1f} {2:.1f}h{3:.2f}v{3:.2f}h-{3:.2f}z\"/>",
        grey, static_cast<double>(column) * cell, static_cast<double>(row) * cell, cell + 0.15);
  }
  std::vector<std::pair<double, double>> places;
  places.reserve(points.size());
  for (const Point& p : points)
    places.emplace_back(shown_width * p.x, height * p.y);
  return figure(title, note, fmt::format("0 0 640 {:.0f}", height),
                "<g shape-rendering=\"crispEdges\">" + drawing + "</g>\n" + dots("dots", places));
}

}  // namespace lab05
