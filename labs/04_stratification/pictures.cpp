#include "pictures.h"

#include "course/viewer/tiles.h"
#include "point_sets.h"

#include <fmt/core.h>

#include <cmath>

namespace lab04 {
namespace {

// The unit square in its frame, y upwards.
carlo::Plot square() {
  return {{0, 1}, {0, 1}, {300, 300}};
}

std::string cell_lines(const carlo::Plot& plot, int lines) {
  std::string path;
  for (int i = 1; i < lines; ++i) {
    const double at = static_cast<double>(i) / lines;
    path += fmt::format("M{0:.1f} {1:.1f}V{2:.1f}M{1:.1f} {0:.1f}H{2:.1f}", plot.x(at), plot.x(0),
                        plot.x(1));
  }
  return fmt::format("<path class=\"grid\" d=\"{}\"/>\n", path);
}

void draw(carlo::Plot& plot, Background background) {
  if (background == Background::disc) {
    plot.add(fmt::format(
        "<path class=\"line c2\" d=\"M{0:.1f} {1:.1f}A{2:.1f} {2:.1f} 0 0 1 {3:.1f} {4:.1f}\"/>\n",
        plot.x(0), plot.y(1), plot.x(1) - plot.x(0), plot.x(1), plot.y(0)));
    return;
  }
  std::string stops;
  constexpr double reach = 0.2;
  for (int i = 0; i <= 8; ++i) {
    const double r = reach * i / 8;
    stops +=
        fmt::format("<stop stop-color=\"currentColor\" offset=\"{:.3f}\" stop-opacity=\"{:.3f}\"/>",
                    i / 8.0, 0.8 * std::exp(-peak_sharpness * r * r));
  }
  plot.add(
      fmt::format("<g class=\"c2\"><defs><radialGradient id=\"lab04-peak\">{}</radialGradient>"
                  "</defs><circle cx=\"{}\" cy=\"{}\" r=\"{}\" fill=\"url(#lab04-peak)\"/></g>\n",
                  stops, plot.x(peak_x), plot.y(peak_y), plot.x(reach) - plot.x(0)));
}

}  // namespace

std::string point_picture(std::string_view title, std::string_view note,
                          const std::vector<Point>& points, int lines) {
  carlo::Plot plot = square();
  plot.add(cell_lines(plot, lines));
  std::vector<carlo::Point> places;
  std::string marks;
  for (const Point& p : points) {
    places.push_back({p.x, p.y});
    marks += fmt::format("M{:.1f} {:.1f}v6M{:.1f} {:.1f}h-6", plot.x(p.x), plot.y(0) + 2,
                         plot.x(0) - 2, plot.y(p.y));
  }
  plot.add(fmt::format("<path class=\"line c2\" d=\"{}\"/>\n", marks));
  plot.dots("c1", places, 7);
  return carlo::tile(title, note, plot);
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
  carlo::Plot plot = square();
  plot.add(
      fmt::format("<g class=\"c1\" fill=\"currentColor\" stroke=\"currentColor\" "
                  "stroke-width=\"{}\">",
                  strata.size() < 500 ? 0.8 : 0.3));
  for (const Stratum& s : strata) {
    const double left = plot.x(s.lower[0]), top = plot.y(s.upper[1]);
    plot.add(
        fmt::format("<rect x=\"{:.2f}\" y=\"{:.2f}\" width=\"{:.2f}\" height=\"{:.2f}\" "
                    "fill-opacity=\"{:.2f}\"/>",
                    left, top, plot.x(s.upper[0]) - left, plot.y(s.lower[1]) - top,
                    0.6 * std::sqrt(density(s) / densest)));
  }
  plot.add("</g>\n");
  draw(plot, background);
  return carlo::tile(title, note, plot);
}

}  // namespace lab04
