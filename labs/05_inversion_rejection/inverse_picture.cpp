#include "course/report/chart.h"
#include "course/viewer/tiles.h"
#include "pictures.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

// The page's slider for inversion by hand.

namespace lab05 {
namespace {

const carlo::Axis& axis() {
  static const carlo::Axis linear{"", carlo::Unit::number, carlo::Scale::linear};
  return linear;
}

/// u at a position of the slider; not quite 1 at the last one.
double u_at(std::size_t position) {
  return std::min(static_cast<double>(position) / inverse_steps, 1 - 0.1 / inverse_steps);
}

/// The density, and under it the slices that the slider has passed.
std::string density_svg(const Inverse& curve) {
  const carlo::Stretch across{curve.view.first, curve.view.last};
  const std::vector<double> ends{0, curve.view.top};
  const carlo::Plot axes(axis(), across, axis(), carlo::round_stretch(axis(), ends),
                         carlo::tile_size);
  carlo::Plot plot = axes;
  for (std::size_t i = 1; i < curve.x.size(); ++i) {
    const double from = curve.x[i - 1], to = std::min(curve.x[i], across.last);
    if (!(from < to)) continue;
    std::vector<carlo::Point> upper = carlo::graph(curve.pdf, {from, to}, 12);
    upper.insert(upper.begin(), {from, upper.front().y});
    upper.push_back({to, upper.back().y});
    const std::vector<carlo::Point> lower{{from, 0}, {to, 0}};
    carlo::Plot slice = axes;
    slice.band("c2", upper, lower);
    plot.add(carlo::shown_at(i, inverse_steps, slice.body()));
  }
  plot.line("c1", carlo::graph(curve.pdf, across));
  return plot.svg("The density of " + curve.name + "; the shaded area under it is u");
}

/// u against x, and the path from u to x.
std::string cdf_svg(const Inverse& curve) {
  const carlo::Stretch across{curve.view.first, curve.view.last};
  const carlo::Plot axes(axis(), across, axis(), {0, 1}, carlo::tile_size);
  carlo::Plot plot = axes;
  std::vector<carlo::Point> line;
  for (std::size_t i = 0; i < curve.x.size(); ++i) {
    line.push_back({curve.x[i], u_at(i)});
    const double end = std::isfinite(curve.x[i]) ? curve.x[i] : across.last;
    const std::vector<carlo::Point> way{{across.first, u_at(i)}, {end, u_at(i)}, {end, 0}};
    carlo::Plot layer = axes;
    layer.line("c2 dashed", way);
    layer.mark("c2", 0, way[1], axis().text(curve.x[i]));
    plot.add(carlo::shown_at(i, i, layer.body()));
  }
  plot.line("c1", line);
  return plot.svg("All samples of " + curve.name + ": x across, u upwards");
}

}  // namespace

std::string inverse_slider(const std::vector<Inverse>& curves) {
  std::vector<std::string> words, pictures;
  for (std::size_t i = 0; i <= inverse_steps; ++i) {
    words.push_back(fmt::format("u = {:.4f}", u_at(i)));
    for (const Inverse& curve : curves)
      words.back() += fmt::format("; {}: x = {:.4f}", curve.name, curve.x[i]);
  }
  for (const Inverse& curve : curves)
    pictures.push_back(carlo::tile(curve.name, "", density_svg(curve) + cdf_svg(curve)));
  return carlo::slider_html("Inversion by hand: u", words, inverse_steps / 3,
                            carlo::tiles(pictures, 19));
}

}  // namespace lab05
