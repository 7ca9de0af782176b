#include "course/report/format.h"
#include "course/viewer/tiles.h"
#include "experiments.h"
#include "goodness.h"
#include "pictures.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

// Points in a disc: by rejection, by inversion, and by a formula that only looks right.

namespace lab05 {
namespace {

struct Way {
  std::string name;
  std::function<Accepted<Point>(carlo::Rng&)> draw;
  bool rejects = false;
};

/// The obvious formula: the subject of the experiment, not an example.
Point crowded(double u_radius, double u_angle) {
  const double angle = 2 * std::numbers::pi * u_angle;
  return {u_radius * std::cos(angle), u_radius * std::sin(angle)};
}

template <class Map>
Accepted<Point> mapped(carlo::Rng& rng, const Map& map) {
  const double u_radius = rng.uniform();
  const double u_angle = rng.uniform();
  return {map(u_radius, u_angle), 1};
}

std::vector<Way> ways() {
  return {{"rejection", disc_by_rejection, true},
          {"inversion", [](carlo::Rng& rng) { return mapped(rng, disc_by_inversion); }},
          {"r = u, which is wrong", [](carlo::Rng& rng) { return mapped(rng, crowded); }}};
}

struct Result {
  Goodness fit;
  double darts = 0;  ///< per point, on average
};

/// Counts in 8 rings of equal area times 12 sectors.
Result measured(const Way& way, std::int64_t n, carlo::Rng rng) {
  constexpr std::size_t rings = 8, sectors = 12;
  std::vector<std::int64_t> counts(rings * sectors);
  std::int64_t thrown = 0;
  for (std::int64_t i = 0; i < n; ++i) {
    const auto [p, darts] = way.draw(rng);
    thrown += darts;
    const double square = p.x * p.x + p.y * p.y;
    if (!(square <= 1 + 1e-12)) continue;
    const double turn = std::atan2(p.y, p.x) / (2 * std::numbers::pi) + 0.5;
    const auto ring = std::min(static_cast<std::size_t>(square * rings), rings - 1);
    const auto sector = std::min(static_cast<std::size_t>(turn * sectors), sectors - 1);
    counts[ring * sectors + sector] += 1;
  }
  const std::vector<double> equal(counts.size(), 1.0 / (rings * sectors));
  return {goodness(counts, equal, n), static_cast<double>(thrown) / static_cast<double>(n)};
}

std::vector<Point> some(const Way& way, carlo::Rng rng) {
  std::vector<Point> points;
  for (int i = 0; i < 1200; ++i)
    points.push_back(way.draw(rng).value);
  return points;
}

/// The darts that rejection throws, including the lost ones.
std::vector<Point> darts(carlo::Rng rng) {
  std::vector<Point> points;
  for (int i = 0; i < 1528; ++i) {
    const double x = 2 * rng.uniform() - 1;
    const double y = 2 * rng.uniform() - 1;
    points.push_back({x, y});
  }
  return points;
}

/// Inversion fed with one jittered pair per cell of a 32 x 32 grid.
std::vector<Point> stratified(carlo::Rng rng) {
  std::vector<Point> points;
  for (int i = 0; i < 32; ++i) {
    for (int j = 0; j < 32; ++j) {
      const double u_radius = (i + rng.uniform()) / 32;
      const double u_angle = (j + rng.uniform()) / 32;
      points.push_back(disc_by_inversion(u_radius, u_angle));
    }
  }
  return points;
}

/// Darts per point with its theoretical 95 % interval: mean 4/pi = 1.27324, geometric.
carlo::Cell darts_cell(const Way& way, double darts, std::int64_t n) {
  if (!way.rejects) return carlo::Cell(darts);
  constexpr double p = std::numbers::pi / 4;
  return carlo::interval_cell(darts, 1.96 * std::sqrt((1 - p) / static_cast<double>(n)) / p);
}

double seconds_of(const Way& way, carlo::Rng rng) {
  return seconds_a_draw(100'000, [&] { return way.draw(rng).value.x; });
}

}  // namespace

void disc_experiment(Notebook& notebook) {
  notebook.begin("A disc, both ways");
  carlo::Table table({"way", "darts a point", "N", "χ²", "p", "time a point"},
                     {"way", "darts", "n", "chi_square", "p", "seconds"});
  std::vector<std::string> pictures;
  double step = 0;
  for (const Way& way : ways()) {
    notebook.progress(step++, 3);
    notebook.attempt([&] {
      const std::int64_t n = notebook.options().n;
      const Result result = measured(way, n, notebook.rng());
      table.add_row({way.name, darts_cell(way, result.darts, n), n, result.fit.statistic,
                     result.fit.p, carlo::seconds_cell(seconds_of(way, notebook.rng()))});
      const std::string note = fmt::format("p = {}{}", carlo::number_text(result.fit.p, 2),
                                           way.rejects ? "; with the lost darts" : "");
      pictures.push_back(disc_picture(
          way.name, note, way.rejects ? darts(notebook.rng()) : some(way, notebook.rng())));
    });
  }
  notebook.attempt([&] {
    pictures.push_back(disc_picture("inversion of stratified numbers",
                                    "one pair in each cell of a 32 x 32 grid",
                                    stratified(notebook.rng())));
  });
  notebook.say(
      "Uniform points of the unit disc. The χ² test counts them in 96 cells of equal area, 8 rings "
      "times 12 sectors. Rejection throws 4/π = 1.27324 darts a point and needs no root, sine or "
      "cosine; "
      "inversion takes exactly two numbers a point and keeps the order of stratified ones.");
  notebook.table("disc", table, "Points in the disc");
  notebook.raw_html(carlo::tiles(pictures, 19));
}

}  // namespace lab05
