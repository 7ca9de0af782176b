#include "course/report/format.h"
#include "course/viewer/tiles.h"
#include "experiments.h"
#include "goodness.h"
#include "pictures.h"

#include <fmt/core.h>

#include <cmath>

// An image of a sky, given by a formula, and the points drawn from it.

namespace lab05 {
namespace {

constexpr std::size_t width = 64, height = 32;

/// Radiance of a sky with a low sun, brighter towards the horizon, over black ground with a pond
/// that mirrors the sun.
double radiance(double x, double y) {
  constexpr double horizon = 0.7, sun_x = 0.3, sun_y = 0.45;
  const auto glow = [&](double dx, double dy, double sharpness) {
    return std::exp(-sharpness * (4 * dx * dx + dy * dy));
  };
  if (y < horizon) {
    return 0.15 + 0.5 * y * y + 20 * glow(x - sun_x, y - sun_y, 400) +
           1.5 * glow(x - sun_x, y - sun_y, 30);
  }
  const double pond = std::hypot((x - 0.35) / 0.22, (y - 0.85) / 0.09);
  return pond < 1 ? 0.1 + 3 * glow(x - sun_x, y - 2 * horizon + sun_y, 150) : 0;
}

std::vector<double> sky() {
  std::vector<double> weights;
  for (std::size_t j = 0; j < height; ++j) {
    for (std::size_t i = 0; i < width; ++i) {
      weights.push_back(radiance((static_cast<double>(i) + 0.5) / width,
                                 (static_cast<double>(j) + 0.5) / height));
    }
  }
  return weights;
}

Point draw(const Tabulated2d& table, carlo::Rng& rng) {
  const double u_row = rng.uniform();
  const double u_column = rng.uniform();
  return table.sample(u_row, u_column);
}

/// Counts of points in the image's cells against the density's integral over each.
Goodness fit(const Tabulated2d& table, std::int64_t n, carlo::Rng rng) {
  std::vector<std::int64_t> counts(width * height);
  for (std::int64_t k = 0; k < n; ++k) {
    const Point p = draw(table, rng);
    if (!(p.x >= 0 && p.x < 1 && p.y >= 0 && p.y < 1)) continue;
    counts[static_cast<std::size_t>(p.y * height) * width +
           static_cast<std::size_t>(p.x * width)] += 1;
  }
  std::vector<double> probabilities;
  for (std::size_t k = 0; k < counts.size(); ++k) {
    const std::size_t column = k % width, row = k / width;
    const Point centre{(static_cast<double>(column) + 0.5) / width,
                       (static_cast<double>(row) + 0.5) / height};
    probabilities.push_back(table.pdf(centre) / (width * height));
  }
  return goodness(counts, probabilities, n);
}

}  // namespace

void image_experiment(Notebook& notebook) {
  notebook.begin("An image as a density");
  notebook.attempt([&] {
    const std::vector<double> weights = sky();
    const Tabulated2d table(weights, width, height);
    carlo::Rng rng = notebook.rng();
    std::vector<Point> points;
    for (int i = 0; i < 1500; ++i)
      points.push_back(draw(table, rng));
    const std::int64_t n = 4 * notebook.options().n;
    const Goodness g = fit(table, n, notebook.rng());
    const double seconds = seconds_a_draw(100'000, [&] { return draw(table, rng).x; });
    notebook.say(
        "A sky of 64 x 32 cells with a low sun over black ground and a pond. Points follow the "
        "light: where the picture is black, none falls. A sphere's rows shrink towards its poles: "
        "with weights that know it, this table becomes the light around a scene in Lab 7.8, and "
        "so the reference renderer draws common/scenes/image_light.xml.");
    carlo::Table result({"N", "cells", "χ²", "p", "time a point"},
                        {"n", "cells", "chi_square", "p", "seconds"});
    result.add_row({n, static_cast<std::int64_t>(g.freedom) + 1, g.statistic, g.p,
                    carlo::seconds_cell(seconds)});
    notebook.table("image", result, "Points against the density's integral over each cell");
    notebook.raw_html(
        carlo::tiles({image_picture("The image", "weights of 64 x 32 cells", weights, width, {}),
                      image_picture("Points drawn from it",
                                    fmt::format("1500 points; χ² over {} cells: p = {}",
                                                g.freedom + 1, carlo::number_text(g.p, 2)),
                                    weights, width, points)},
                     19));
  });
}

}  // namespace lab05
