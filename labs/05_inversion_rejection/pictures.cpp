#include "pictures.h"

#include "course/viewer/packed.h"
#include "course/viewer/tiles.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace lab05 {
namespace {

/// Draws the darts that were kept, and paler those that were lost.
void draw_darts(carlo::Plot& plot, std::span<const Point> darts,
                const std::function<bool(Point)>& keeps) {
  std::vector<carlo::Point> kept, lost;
  for (const Point& dart : darts)
    (keeps(dart) ? kept : lost).push_back({dart.x, dart.y});
  plot.add("<g opacity=\"0.45\">");
  plot.dots("c2", lost, 2.8);
  plot.add("</g>");
  plot.dots("c1", kept, 2.8);
}

}  // namespace

std::string darts_picture(std::string_view title, std::string_view note, const View& view,
                          const Function& f, std::span<const Point> darts) {
  const carlo::Axis axis{"", carlo::Unit::number, carlo::Scale::linear};
  const std::vector<double> ends{0, view.top};
  const carlo::Stretch across{view.first, view.last};
  carlo::Plot plot(axis, across, axis, carlo::round_stretch(axis, ends), carlo::tile_size);
  draw_darts(plot, darts, [&](Point dart) { return dart.y < f(dart.x); });
  plot.line("c2", carlo::graph(f, across));
  return carlo::tile(title, note, plot);
}

std::string disc_picture(std::string_view title, std::string_view note,
                         std::span<const Point> points) {
  carlo::Plot plot({-1, 1}, {-1, 1}, {300, 300});
  draw_darts(plot, points, [](Point p) { return p.x * p.x + p.y * p.y <= 1; });
  plot.add(fmt::format("<circle class=\"axis\" cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{:.1f}\"/>\n",
                       plot.x(0), plot.y(0), plot.x(1) - plot.x(0)));
  return carlo::tile(title, note, plot);
}

std::string image_picture(std::string_view title, std::string_view note,
                          std::span<const double> weights, std::size_t width,
                          std::span<const Point> points) {
  const double brightest = *std::max_element(weights.begin(), weights.end());
  std::vector<double> greys;
  for (const double weight : weights) {
    // Shown as the cube root, so that dim parts are visible beside the brightest.
    greys.push_back(std::pow(weight / brightest, 2.2 / 3));
  }
  const double columns = static_cast<double>(width);
  const double rows = static_cast<double>(weights.size()) / columns;
  carlo::Plot plot({0, 1}, {1, 0}, {400, 400 * rows / columns});
  plot.add(
      fmt::format("<image x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" "
                  "preserveAspectRatio=\"none\" style=\"image-rendering: pixelated\" "
                  "href=\"{}\"/>\n",
                  plot.x(0), plot.y(0), plot.x(1) - plot.x(0), plot.y(1) - plot.y(0),
                  carlo::picture_url(carlo::grey_image(greys, width), 1)));
  std::vector<carlo::Point> places;
  for (const Point& p : points)
    places.push_back({p.x, p.y});
  plot.dots("c6", places, 2.2);
  return carlo::tile(title, note, plot);
}

}  // namespace lab05
