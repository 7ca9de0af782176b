#include "course/report/format.h"
#include "course/report/stopwatch.h"
#include "course/viewer/tiles.h"
#include "course/viewer/turntable.h"
#include "experiments.h"
#include "goodness.h"
#include "numeric/robust.h"

#include <fmt/core.h>

#include <cmath>

// The directions of each sampler: on a rotatable hemisphere, and against their densities.

namespace lab07 {
namespace {

struct Sampler {
  std::string name, note;
  double lowest;  ///< the least height in the histogram
  std::function<Vec3(carlo::Rng&)> draw;
  Pdf pdf;
  std::vector<Vec3> arrows = {};  ///< directions drawn as lines
};

template <class Draw>
std::function<Vec3(carlo::Rng&)> from_two(const Draw& draw) {
  return [draw](carlo::Rng& rng) {
    const float x = rng.uniform_float();
    const float y = rng.uniform_float();
    return draw(Vec2(x, y));
  };
}

Sampler lobe_about_mirror(float n, double degrees) {
  const double theta = degrees * carlo::pi / 180;
  const Vec3 wo(-std::sin(theta), 0, std::cos(theta));
  return {
      fmt::format("lobe n = {:g}, wo at {:g}°", n, degrees),
      "Lab 7.6. The orange lines: wo, and the mirror direction that the lobe surrounds. What lies "
      "below the ring is absorbed.",
      -1,
      from_two([=](Vec2 u) { return sample_mirror_lobe(u, wo, n); }),
      [=](Vec3 w) { return mirror_lobe_pdf(w, wo, n); },
      {wo, {-wo.x, -wo.y, wo.z}}};
}

std::vector<Sampler> samplers() {
  return {
      {"uniform, by rejection", "Lab 7.2. As many in each patch of the same area.", 0,
       [](carlo::Rng& rng) {
         return sample_uniform_by_rejection({0, 0, 1}, rng).w;
       },
       uniform_hemisphere_pdf},
      {"uniform, by inversion", "Lab 7.3. As many in each patch of the same area.", 0,
       from_two(sample_uniform_hemisphere), uniform_hemisphere_pdf},
      {"cosine-weighted",
       "Lab 7.4. Sparse at the horizon. Look from above: there the points are uniform on the disc.",
       0, from_two(sample_cosine_hemisphere), cosine_hemisphere_pdf},
      {"lobe n = 20", "Lab 7.5. A lobe around the normal.", 0,
       from_two([](Vec2 u) { return sample_lobe(u, 20); }), [](Vec3 w) { return lobe_pdf(w, 20); }},
      lobe_about_mirror(20, 70),
      lobe_about_mirror(100, 45),
  };
}

/// World coordinates, z upwards, in the picture's cube, where y is upwards.
std::array<double, 3> in_cube(Vec3 w) {
  return {0.5 + 0.75 * w.y, 0.25 + 0.75 * w.z, 0.5 + 0.75 * w.x};
}

carlo::Polyline circle(double height, double from, double to,
                       const std::function<Vec3(double, double)>& at) {
  carlo::Polyline line;
  for (int i = 0; i <= 72; ++i)
    line.push_back(in_cube(at(from + (to - from) * i / 72, height)));
  return line;
}

/// The horizon, two rings above it, two arcs across, and the normal.
std::vector<carlo::Polyline> hemisphere_wires() {
  const auto ring = [](double phi, double z) {
    const double sine = std::sqrt(1 - z * z);
    return Vec3(sine * std::cos(phi), sine * std::sin(phi), z);
  };
  const auto arc = [](double theta, double phi) {
    return Vec3(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta));
  };
  std::vector<carlo::Polyline> wires;
  for (const double z : {0.0, 0.5, std::sqrt(0.75)})
    wires.push_back(circle(z, 0, 2 * carlo::pi, ring));
  for (const double phi : {0.0, carlo::pi / 2})
    wires.push_back(circle(phi, -carlo::pi / 2, carlo::pi / 2, arc));
  wires.push_back({in_cube({0, 0, 0}), in_cube({0, 0, 1.15f})});
  return wires;
}

carlo::Cloud cloud_of(const Sampler& sampler, std::span<const Vec3> directions) {
  carlo::Cloud cloud{sampler.name, sampler.note, {}, {}, {}};
  for (const Vec3 w : directions.first(std::min<std::size_t>(directions.size(), 2000)))
    cloud.points.push_back(in_cube(w));
  for (const Vec3 w : sampler.arrows)
    cloud.lines.push_back({in_cube({0, 0, 0}), in_cube(1.1f * w)});
  return cloud;
}

struct Drawn {
  std::vector<Vec3> directions;
  double seconds = 0;  ///< per direction
};

Drawn draw(const Sampler& sampler, std::int64_t count, carlo::Rng rng) {
  Drawn drawn;
  drawn.directions.reserve(static_cast<std::size_t>(count));
  const carlo::Stopwatch watch;
  for (std::int64_t i = 0; i < count; ++i)
    drawn.directions.push_back(sampler.draw(rng));
  const double spent = watch.seconds();
  drawn.seconds = spent / static_cast<double>(count);
  return drawn;
}

std::string histogram_of(const Sampler& sampler, const Drawn& drawn, const Goodness& fit) {
  constexpr std::size_t cells = 40;
  std::vector<double> bars(cells);
  const double width = (1 - sampler.lowest) / cells;
  for (const Vec3 w : drawn.directions) {
    const double place = (w.z - sampler.lowest) / width;
    if (place >= 0) bars[std::min(static_cast<std::size_t>(place), cells - 1)] += 1;
  }
  for (double& bar : bars)
    bar /= static_cast<double>(drawn.directions.size()) * width;
  const auto density = [&](double z) { return density_of_height(sampler.pdf, z); };
  const carlo::Stretch across{sampler.lowest, 1};
  double top = *std::max_element(bars.begin(), bars.end());
  for (const carlo::Point& p : carlo::graph(density, across))
    top = std::max(top, p.y);
  return carlo::histogram_tile(
      sampler.name,
      fmt::format("χ² = {} with {} degrees of freedom, p = {}: {}",
                  carlo::number_text(fit.statistic, 3), fit.freedom, carlo::number_text(fit.p, 2),
                  fit.p < 1e-6 ? "they do not fit" : "no contradiction"),
      across, top, bars, density);
}

void rejection_cost(Notebook& notebook, carlo::Table& table) {
  const std::int64_t count = notebook.options().n / 4;
  carlo::Rng rng = notebook.rng();
  std::int64_t darts = 0;
  for (std::int64_t i = 0; i < count; ++i)
    darts += sample_uniform_by_rejection({0, 0, 1}, rng).darts;
  const double p = carlo::pi / 6, n = static_cast<double>(count);
  table.add_row({count,
                 carlo::interval_cell(static_cast<double>(darts) / n,
                                      1.96 * std::sqrt(1 - p) / p / std::sqrt(n)),
                 1 / p});
}

}  // namespace

void samplers_experiment(Notebook& notebook) {
  notebook.begin("Directions against their densities");
  const std::int64_t n = notebook.options().n;
  carlo::Table table({"sampler", "N", "cells", "χ²", "p", "time a direction"},
                     {"sampler", "n", "cells", "chi_square", "p", "seconds"});
  carlo::Turntable picture{"Directions on the hemisphere",
                           "Directions as points on a hemisphere.",
                           "",
                           hemisphere_wires(),
                           {}};
  std::vector<std::string> histograms;
  double step = 0;
  for (const Sampler& sampler : samplers()) {
    notebook.progress(step++, 6);
    notebook.attempt([&] {
      const Drawn drawn = draw(sampler, n, notebook.rng());
      picture.clouds.push_back(cloud_of(sampler, drawn.directions));
      const Goodness fit = goodness(drawn.directions, sampler.pdf);
      table.add_row({sampler.name, n, static_cast<std::int64_t>(fit.freedom) + 1, fit.statistic,
                     fit.p, carlo::seconds_cell(drawn.seconds)});
      histograms.push_back(histogram_of(sampler, drawn, fit));
    });
  }
  if (picture.clouds.empty()) return;
  notebook.say(
      "Each sampler's directions, on the page as points on a hemisphere that you can turn; and "
      "counted in cells of the whole sphere, rings by sectors, against the integral of the "
      "density that belongs to the sampler (cells where fewer than 100 are expected are pooled). "
      "The histograms show the heights cos(theta).");
  notebook.raw_html(turntable_html(picture));
  notebook.script(carlo::turntable_script());
  notebook.table("samplers", table, "Directions against the integrals of their densities");
  notebook.raw_html(carlo::tiles(histograms, 19));
  carlo::Table darts({"directions", "darts a direction", "theory 6/π"}, {"n", "darts", "theory"});
  notebook.attempt([&] { rejection_cost(notebook, darts); });
  notebook.table("darts", darts, "What rejection costs in darts, with 95 % interval");
}

}  // namespace lab07
