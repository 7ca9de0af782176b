#include "pictures.h"

#include "point_sets.h"
#include "report/page.h"

#include <fmt/core.h>

#include <cmath>

namespace lab04 {
namespace {

// The square is drawn 400 units wide, y upwards, with room for the marks at its edges.
constexpr double side = 400;

constexpr std::string_view style = R"(<style>
.tiles { display: grid; gap: 1.5rem; margin: 1.5rem 0;
         grid-template-columns: repeat(auto-fit, minmax(min(100%, 12.25rem), 1fr)); }
.tiles figcaption { min-height: 3em; }
.tiles svg { display: block; width: 100%; height: auto; }
.tiles .frame { fill: none; stroke: var(--soft); stroke-width: 1.5; }
.tiles .cells { fill: none; stroke: var(--rule); stroke-width: 1; }
.tiles .dots { fill: var(--series-1); }
.tiles .marks { fill: none; stroke: var(--series-2); stroke-width: 1.5; }
.tiles .strata rect { stroke: var(--series-1); fill: var(--series-1); }
.tiles .shape { fill: none; stroke: var(--series-2); stroke-width: 3; }
.tiles .glow { stop-color: var(--series-2); }
</style>
)";

double down(double y) {
  return side * (1 - y);
}

std::string tile(std::string_view title, std::string_view note, const std::string& drawing) {
  return fmt::format(
      "<figure>\n<figcaption>{0}<span>{1}</span></figcaption>\n"
      "<svg viewBox=\"-14 -2 416 416\" role=\"img\" aria-label=\"{0}: {1}\">\n{2}"
      "<rect class=\"frame\" width=\"400\" height=\"400\"/>\n</svg>\n</figure>\n",
      carlo::html_escaped(title), carlo::html_escaped(note), drawing);
}

std::string cell_lines(int lines) {
  std::string path;
  for (int i = 1; i < lines; ++i) {
    const double at = side * i / lines;
    path += fmt::format("M{0:.1f} 0V400M0 {0:.1f}H400", at);
  }
  return fmt::format("<path class=\"cells\" d=\"{}\"/>\n", path);
}

std::string shape(Background background) {
  if (background == Background::disc) {
    return "<path class=\"shape\" d=\"M0 0A400 400 0 0 1 400 400\"/>\n";
  }
  std::string stops;
  constexpr double reach = 0.2;
  for (int i = 0; i <= 8; ++i) {
    const double r = reach * i / 8;
    stops += fmt::format("<stop class=\"glow\" offset=\"{:.3f}\" stop-opacity=\"{:.3f}\"/>",
                         i / 8.0, 0.8 * std::exp(-peak_sharpness * r * r));
  }
  return fmt::format(
      "<defs><radialGradient id=\"lab04-peak\">{}</radialGradient></defs>"
      "<circle cx=\"{}\" cy=\"{}\" r=\"{}\" fill=\"url(#lab04-peak)\"/>\n",
      stops, side * peak_x, down(peak_y), side * reach);
}

}  // namespace

std::string tiles(const std::vector<std::string>& pictures) {
  std::string html = std::string(style) + "<div class=\"tiles\">\n";
  for (const std::string& picture : pictures)
    html += picture;
  return html + "</div>\n";
}

std::string point_picture(std::string_view title, std::string_view note,
                          const std::vector<Point>& points, int lines) {
  std::string dots, marks;
  for (const Point& p : points) {
    const double x = side * p.x, y = down(p.y);
    dots += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"5\"/>", x, y);
    marks += fmt::format("M{:.1f} 403v9M-3 {:.1f}h-9", x, y);
  }
  return tile(title, note,
              fmt::format("{}<path class=\"marks\" d=\"{}\"/>\n<g class=\"dots\">{}</g>\n",
                          cell_lines(lines), marks, dots));
}

std::string strata_picture(std::string_view title, std::string_view note,
                           const std::vector<Stratum>& strata, Background background) {
  double densest = 0;
  const auto density = [](const Stratum& s) {
    const double area = (s.upper[0] - s.lower[0]) * (s.upper[1] - s.lower[1]);
    return static_cast<double>(s.points) / area;
  };
  for (const Stratum& s : strata)
    densest = std::fmax(densest, density(s));
  std::string boxes;
  for (const Stratum& s : strata) {
    boxes += fmt::format(
        "<rect x=\"{:.2f}\" y=\"{:.2f}\" width=\"{:.2f}\" height=\"{:.2f}\" "
        "fill-opacity=\"{:.2f}\"/>",
        side * s.lower[0], down(s.upper[1]), side * (s.upper[0] - s.lower[0]),
        side * (s.upper[1] - s.lower[1]), 0.6 * std::sqrt(density(s) / densest));
  }
  const double line = strata.size() < 500 ? 1 : 0.4;
  return tile(title, note,
              fmt::format("<g class=\"strata\" stroke-width=\"{}\">{}</g>\n{}", line, boxes,
                          shape(background)));
}

}  // namespace lab04
