#include "course/report/format.h"
#include "course/report/stopwatch.h"
#include "course/viewer/tiles.h"
#include "experiments.h"
#include "images/views.h"
#include "stats/running_mean.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>
#include <optional>
#include <string>
#include <vector>

// Step d: photons where they land, as dots and as irradiance; and their total power.

namespace lab09 {
namespace {

constexpr double pi = std::numbers::pi;

// Dots --------------------------------------------------------------------------------------------

/// A dot for each photon that the camera sees, in the colour of its flux: `first` for the first
/// photons sent, `all` for all.
struct Dots {
  carlo::Image first, all;
  std::int64_t stored = 0;

  explicit Dots(int size) : first(size, size), all(size, size) {}
};

/// The index of the pixel that shows a point, or none.
std::optional<std::size_t> pixel_of(const lab08::View& view, Vec3 p) {
  const carlo::Camera& camera = view.world.scene().camera;
  const Vec3 d = p - camera.origin;
  const float depth = glm::dot(d, camera.forward);
  if (!(depth > 0)) return std::nullopt;
  const float x = glm::dot(d, camera.right) / (depth * camera.tan_half_x);
  const float y = glm::dot(d, camera.up) / (depth * camera.tan_half_y);
  if (!(std::abs(x) < 1 && std::abs(y) < 1)) return std::nullopt;
  const float length = glm::length(d);
  const auto met = view.world.intersect({camera.origin, d / length});
  if (!met || glm::distance(met->p, p) > 1e-3f * length) return std::nullopt;
  const auto across = [&](float place) {
    return std::min(static_cast<int>((place + 1) / 2 * static_cast<float>(view.size)),
                    view.size - 1);
  };
  return static_cast<std::size_t>(across(-y) * view.size + across(x));
}

Dots dots_of(const lab08::View& view, std::int64_t few, std::int64_t many, Rng& rng) {
  Dots dots(view.size);
  for (std::int64_t i = 0; i < many; ++i) {
    trace_photon(view.world, emit_photon(view.world, rng), rng, [&](const Photon& photon) {
      ++dots.stored;
      const auto pixel = pixel_of(view, photon.p);
      if (!pixel) return;
      const Rgb colour = photon.flux / std::max({photon.flux.r, photon.flux.g, photon.flux.b});
      dots.all.pixels[*pixel] += colour;
      if (i < few) dots.first.pixels[*pixel] += colour;
    });
  }
  return dots;
}

void show_dots(Notebook& notebook) {
  const lab08::View view(lab08::room_with_balls(), lab08::image_size(notebook, 320));
  Rng rng = notebook.rng();
  const std::int64_t few = 10'000, many = notebook.options().n;
  const Dots dots = dots_of(view, few, many, rng);
  notebook.say(
      "Photons as dots, where the camera sees them, in the colour in which they arrive. None "
      "lies on the ball of mirror or on the ball of glass: look for the light that they focus "
      "beside them.");
  const auto title = [](std::int64_t sent) {
    return fmt::format("{} photons sent", carlo::count_text(sent));
  };
  const double many_white = 4 * lab08::mean_value(dots.all);
  notebook.raw_html(carlo::tiles(
      {carlo::image_tile(title(few), "each a dot", dots.first, 1),
       carlo::image_tile(title(many), fmt::format("{} stored", carlo::count_text(dots.stored)),
                         dots.all, many_white)}));
}

// Irradiance --------------------------------------------------------------------------------------

/// A black floor, z = 0, below a point light of intensity 1 at height 1.
carlo::Scene floor_alone() {
  carlo::Scene scene;
  scene.materials = {{carlo::Phong{Rgb(0), Rgb(0), 0}, false}};
  scene.shapes = {{carlo::Parallelogram{{-50, -50, 0}, {100, 0, 0}, {0, 100, 0}}, 0, Rgb(0)}};
  return scene;
}

/// The flux through a disc below the light: its solid angle.
double flux_through(double radius) {
  return 2 * pi * (1 - 1 / std::hypot(1, radius));
}

double irradiance_at(double r) {
  return std::pow(1 + r * r, -1.5);
}

/// The distances from the foot of the light at which this many of its photons land, of those on the
/// floor.
std::vector<double> landing_radii(const World& world, std::int64_t photons, Rng& rng) {
  std::vector<double> radii;
  for (std::int64_t i = 0; i < photons; ++i) {
    trace_photon(world, emit_from_point({0, 0, 1}, Rgb(1), rng), rng,
                 [&](const Photon& photon) { radii.push_back(glm::length(glm::dvec2(photon.p))); });
  }
  return radii;
}

/// Irradiance in rings of this width, by counting, beside the closed form.
void rings(Notebook& notebook, const World& world) {
  constexpr int count = 24;
  constexpr double width = 0.125, to = count * width;
  const carlo::Axis across{"distance from the foot", carlo::Unit::number, carlo::Scale::linear};
  const carlo::Axis up{"irradiance", carlo::Unit::number, carlo::Scale::linear};
  carlo::Table table({"photons", "from", "to", "closed form", "counted"},
                     {"photons", "from", "to", "exact", "counted"});
  std::vector<std::string> tiles;
  for (const std::int64_t photons : {notebook.options().n / 256, notebook.options().n}) {
    carlo::Plot plot(across, {0, to}, up, {0, 1.2}, carlo::tile_size);
    plot.line("c1", carlo::graph(irradiance_at, {0, to}));
    Rng rng = notebook.rng();
    std::array<double, count> counts{};
    for (const double r : landing_radii(world, photons, rng)) {
      if (r < to) counts[static_cast<std::size_t>(r / width)] += 1;
    }
    for (int ring = 0; ring < count; ++ring) {
      const double from = ring * width, area = pi * width * (2 * from + width);
      const double flux = 4 * pi / static_cast<double>(photons);
      const double hits = counts[static_cast<std::size_t>(ring)];
      const double counted = hits * flux / area;
      const double half_width = 1.96 * std::sqrt(std::max(hits, 1.0)) * flux / area;
      plot.error_bar("c2", {from + width / 2, counted}, half_width);
      plot.mark("c2", 1, {from + width / 2, counted}, fmt::format("{:g} photons", hits));
      table.add_row({photons, from, from + width,
                     (flux_through(from + width) - flux_through(from)) / area,
                     carlo::interval_cell(counted, half_width)});
    }
    tiles.push_back(carlo::tile(fmt::format("{} photons", carlo::count_text(photons)),
                                "line: I cos θ/d²; marks: counted in rings, 95 % intervals",
                                plot.svg("irradiance under a point light")));
  }
  notebook.say(
      "A point light over a floor. As many photons land on a piece of it as its irradiance says: "
      "their number times the flux of one, over its area.");
  notebook.raw_html(carlo::tiles(tiles));
  notebook.data("photon_rings", table, "Irradiance under a point light, ring by ring");
}

/// Photons in a disc as an estimate of the irradiance at its middle: bias and noise.
void discs(Notebook& notebook, const World& world) {
  carlo::Table table(
      {"radius of the disc", "photons sent", "bias, closed form", "bias, measured", "noise"},
      {"radius", "photons", "bias", "bias_measured", "noise"});
  constexpr double radii[] = {0.03, 0.1, 0.3, 1};
  constexpr int runs = 64;
  const std::int64_t most = notebook.options().n / runs;
  for (const std::int64_t photons : {most / 16, most}) {
    std::array<std::vector<double>, std::size(radii)> estimates;
    for (int run = 0; run < runs; ++run) {
      Rng rng = notebook.rng();
      std::vector<double> landed = landing_radii(world, photons, rng);
      std::sort(landed.begin(), landed.end());
      for (std::size_t i = 0; i < std::size(radii); ++i) {
        const auto inside = std::lower_bound(landed.begin(), landed.end(), radii[i]);
        const auto hits = static_cast<double>(inside - landed.begin());
        estimates[i].push_back(hits * 4 / (static_cast<double>(photons) * radii[i] * radii[i]));
      }
    }
    for (std::size_t i = 0; i < std::size(radii); ++i) {
      const double bias = flux_through(radii[i]) / (pi * radii[i] * radii[i]) - 1;
      const double noise = std::sqrt(split_error(estimates[i], 1).variance);
      const double measured =
          std::accumulate(estimates[i].begin(), estimates[i].end(), 0.0) / runs - 1;
      table.add_row(
          {radii[i], photons, carlo::percent_cell(bias, 2),
           carlo::Cell(fmt::format("{} %", carlo::interval_text(100 * measured,
                                                                196 * noise / std::sqrt(runs))),
                       measured),
           carlo::percent_cell(noise, 2)});
    }
  }
  notebook.table("photon_discs", table,
                 "The irradiance at the middle of a disc, estimated from the photons in it: its "
                 "relative bias and noise, from 64 runs; 95 % intervals");
}

// Power -------------------------------------------------------------------------------------------

/// A small light in a closed sphere of this albedo.
carlo::Scene light_in_sphere(float albedo) {
  carlo::Scene scene;
  scene.materials = {{carlo::Diffuse{Rgb(albedo)}, false}, {carlo::Diffuse{Rgb(0)}, false}};
  scene.shapes = {{carlo::Sphere{{0, 0, 0}, 1, true}, 0, Rgb(0)},
                  {carlo::Sphere{{0.3f, 0, 0}, 1e-3f}, 1, Rgb(1, 2, 4)}};
  return scene;
}

void power(Notebook& notebook) {
  carlo::Table table({"world", "photons", "green flux stored over the power", "closed form", "time",
                      "photons per second"},
                     {"world", "photons", "stored", "exact", "seconds", "rate"});
  const auto measure = [&](const std::string& name, const World& world, const carlo::Cell& exact) {
    const std::int64_t photons = notebook.options().n;
    const auto count = static_cast<double>(photons);
    Rng rng = notebook.rng();
    Rgb power(0);
    for (const Light& light : world.lights())
      power += carlo::pi_f * light.area() * light.sample({0.5f, 0.5f}).radiance;
    double of_one = 0;
    carlo::RunningMean stored;
    const carlo::Stopwatch watch;
    for (std::int64_t i = 0; i < photons; ++i) {
      of_one = 0;
      trace_photon(world, emit_photon(world, rng), rng, [&](const Photon& photon) {
        of_one += static_cast<double>(photon.flux.g / power.g);
      });
      stored.add(of_one);
    }
    const double seconds = watch.seconds(), half_width = std::max(1.96 * stored.error(), 1e-7);
    table.add_row({name, photons, carlo::interval_cell(stored.mean(), half_width), exact,
                   carlo::seconds_cell(seconds),
                   carlo::Cell(carlo::count_text(static_cast<std::int64_t>(count / seconds)),
                               count / seconds)});
  };
  for (const float albedo : {0.0f, 0.5f, 0.9f}) {
    measure(fmt::format("a sphere of albedo {:g}", static_cast<double>(albedo)),
            World(light_in_sphere(albedo)), 1 / (1 - static_cast<double>(albedo)));
  }
  measure("the Cornell box", World(lab08::cornell_box()), carlo::empty_cell());
  measure("the room with balls", World(lab08::room_with_balls()), carlo::empty_cell());
  notebook.table(
      "photon_power", table,
      "Each reflection leaves the albedo's share: 1 + ρ + ρ² + ... = 1/(1 - ρ) of the power "
      "arrives in all. On one processor; 95 % intervals");
}

}  // namespace

void photons_experiment(Notebook& notebook) {
  notebook.begin("Step d: photons from the lights");
  notebook.attempt([&] { show_dots(notebook); });
  notebook.progress(1, 3);
  notebook.attempt([&] {
    const World world(floor_alone());
    rings(notebook, world);
    discs(notebook, world);
  });
  notebook.progress(2, 3);
  notebook.attempt([&] { power(notebook); });
}

}  // namespace lab09
