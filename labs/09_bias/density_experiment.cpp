#include "course/report/format.h"
#include "experiments.h"
#include "numeric/robust.h"
#include "shown_error.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>
#include <vector>

// Step e: irradiance from photons where it is known, and where a disc extends over an edge.

namespace lab09 {
namespace {

/// A point of the floor z = 0, seen from above.
Surface floor_point(Vec3 p) {
  static const lab08::Material white = carlo::Phong{Rgb(1), Rgb(0), 0};
  return {p, {0, 0, 1}, {0, 0, 1}, Rgb(0), &white, true, {}};
}

/// With this BRDF, radiance is irradiance.
Rgb one(Vec3) {
  return Rgb(1);
}

// Under a point light -----------------------------------------------------------------------------

/// A point light of intensity 1 at height 1: the irradiance at its foot is 1, and a disc about it
/// takes all light of a cone.
double cone_share(double radius) {
  return (1 - 1 / std::hypot(1, radius)) / 2;
}

double disc_mean(double radius) {
  return 4 * cone_share(radius) / (radius * radius);
}

/// Both parts of the error of photons within a radius, if this many are emitted.
ErrorParts within_theory(double radius, double emitted) {
  const double bias = disc_mean(radius) - 1, share = cone_share(radius);
  return {bias * bias, disc_mean(radius) * disc_mean(radius) * (1 - share) / (share * emitted)};
}

/// The photons of the light that land within a distance of its foot, without tracing rays.
PhotonMap map_below(std::int64_t emitted, Rng& rng) {
  constexpr float farthest = 8;
  std::vector<Photon> photons;
  for (std::int64_t i = 0; i < emitted; ++i) {
    const Emission emission = emit_from_point({0, 0, 1}, Rgb(1), rng);
    const Vec3 d = emission.ray.d;
    if (!(d.z < 0)) continue;
    const Vec3 p(-d.x / d.z, -d.y / d.z, 0);
    if (glm::length(p) < farthest) photons.push_back({p, -d, emission.flux});
  }
  return {std::move(photons), 1 / static_cast<float>(emitted)};
}

constexpr int below_maps = 512;

using Estimate = std::function<Rgb(const PhotonMap& map)>;

/// Bias and noise of several estimates at the foot, by as many maps.
std::vector<ErrorParts> errors_below(Notebook& notebook, std::int64_t emitted,
                                     const std::vector<Estimate>& estimates) {
  const int maps = notebook.repetitions(below_maps);
  std::vector<std::vector<double>> values(estimates.size());
  Rng rng = notebook.rng();
  for (int i = 0; i < maps; ++i) {
    const PhotonMap map = map_below(emitted, rng);
    for (std::size_t k = 0; k < estimates.size(); ++k)
      values[k].push_back(static_cast<double>(estimates[k](map).g));
  }
  std::vector<ErrorParts> parts;
  for (const std::vector<double>& list : values)
    parts.push_back(split_error(list, 1));
  return parts;
}

constexpr std::int64_t emitted_below = 1 << 13;

carlo::Chart against_radius(Notebook& notebook) {
  carlo::Chart chart{"Photons within a radius",
                     "by closed form, and both together as measured",
                     {"radius"},
                     {"relative error"},
                     {{"bias", {}}, {"noise", {}}, {"both", {}}, {"both, measured", {}}}};
  carlo::Table table({"radius", "photons on average", "bias", "measured", "noise", "measured"},
                     {"radius", "photons", "bias", "bias_measured", "noise", "noise_measured"});
  std::vector<double> radii;
  std::vector<Estimate> estimates;
  for (int i = 0; i <= 12; ++i) {
    const double radius = 0.03 * std::exp2(i / 2.0);
    radii.push_back(radius);
    estimates.push_back([radius](const PhotonMap& map) {
      return radiance_within(map, floor_point(Vec3(0)), one, static_cast<float>(radius));
    });
  }
  const std::vector<ErrorParts> measured = errors_below(notebook, emitted_below, estimates);
  for (std::size_t i = 0; i < radii.size(); ++i) {
    const ErrorParts theory = within_theory(radii[i], emitted_below);
    const double bias = std::sqrt(theory.bias2), noise = std::sqrt(theory.variance);
    chart.series[0].points.push_back({radii[i], bias});
    chart.series[1].points.push_back({radii[i], noise});
    chart.series[2].points.push_back({radii[i], total_error(theory)});
    chart.series[3].points.push_back({radii[i], total_error(measured[i])});
    table.add_row(
        {carlo::number_cell(radii[i], 2), carlo::number_cell(cone_share(radii[i]) * emitted_below),
         carlo::percent_cell(bias), percent_of_root(measured[i].bias2, 3),
         carlo::percent_cell(noise), carlo::percent_cell(std::sqrt(measured[i].variance))});
  }
  notebook.numbers(
      "density_radius", table,
      fmt::format("At the foot of a point light, by photons within a radius; {}", minus_is_noise));
  return chart;
}

/// The estimates from k photons, with the k-th and without.
carlo::Chart against_count(Notebook& notebook) {
  carlo::Chart chart{"The k nearest photons",
                     "as measured; the larger the k, the larger the disc",
                     {"k"},
                     {"relative error"},
                     {{"bias", {}}, {"noise", {}}, {"both", {}}}};
  carlo::Table table({"k", "bias", "noise", "bias if the k-th is added"},
                     {"k", "bias", "noise", "bias_with_kth"});
  const std::vector<int> counts = {4, 8, 16, 32, 64, 128, 256, 512, 1024};
  std::vector<Estimate> estimates;
  for (const int k : counts) {
    estimates.push_back(
        [k](const PhotonMap& map) { return radiance_nearest(map, floor_point(Vec3(0)), one, k); });
  }
  // All photons carry the same flux, so one more changes the result by a factor.
  for (const int k : counts) {
    estimates.push_back([k](const PhotonMap& map) {
      return radiance_nearest(map, floor_point(Vec3(0)), one, k) * static_cast<float>(k) /
             static_cast<float>(k - 1);
    });
  }
  const std::vector<ErrorParts> parts = errors_below(notebook, emitted_below, estimates);
  for (std::size_t i = 0; i < counts.size(); ++i) {
    const double k = counts[i], bias = signed_root(parts[i].bias2);
    // Values that may well be noise do not belong on logarithmic axes.
    const double doubtful = 4 * parts[i].variance / notebook.repetitions(below_maps);
    if (parts[i].bias2 > doubtful) chart.series[0].points.push_back({k, bias});
    chart.series[1].points.push_back({k, std::sqrt(parts[i].variance)});
    chart.series[2].points.push_back({k, total_error(parts[i])});
    table.add_row({counts[i], percent_of_root(parts[i].bias2, 3),
                   carlo::percent_cell(std::sqrt(parts[i].variance)),
                   percent_of_root(parts[i + counts.size()].bias2, 3)});
  }
  notebook.table("density_nearest", table,
                 fmt::format("The same by the k nearest photons; {}", minus_is_noise));
  return chart;
}

// At an edge --------------------------------------------------------------------------------------

/// The fraction of a disc of radius 1 on this side of a line at a distance from its middle.
double share_before(double distance) {
  const double d = std::min(distance, 1.0);
  return 1 - (std::acos(d) - d * std::sqrt(1 - d * d)) / carlo::pi;
}

/// Photons of irradiance 1, uniform on the floor x > 0, y > 0 up to 4.
PhotonMap map_of_corner(Rng& rng) {
  constexpr int count = 4096;
  std::vector<Photon> photons;
  for (int i = 0; i < count; ++i) {
    const float x = 4 * rng.uniform_float();
    const float y = 4 * rng.uniform_float();
    photons.push_back({{x, y, 0}, {0, 0, 1}, Rgb(16)});
  }
  return {std::move(photons), 1.0f / count};
}

void at_edges(Notebook& notebook) {
  carlo::Table table(
      {"where the disc's middle lies", "closed form", "photons within 1", "the 256 nearest"},
      {"place", "exact", "within", "nearest"});
  struct Place {
    std::string name;
    Vec3 p;
    double share;
  };
  std::vector<Place> places;
  for (const double d : {1.0, 0.75, 0.5, 0.25, 0.0})
    places.push_back({d == 0 ? "on the edge" : fmt::format("{:g} radii from the edge", d),
                      {2, static_cast<float>(d), 0},
                      share_before(d)});
  places.push_back({"at a corner", {0, 0, 0}, 0.25});
  const int maps = notebook.repetitions(256);
  std::vector<std::vector<double>> within(places.size()), nearest(places.size());
  Rng rng = notebook.rng();
  for (int i = 0; i < maps; ++i) {
    const PhotonMap map = map_of_corner(rng);
    for (std::size_t k = 0; k < places.size(); ++k) {
      const Surface surface = floor_point(places[k].p);
      within[k].push_back(static_cast<double>(radiance_within(map, surface, one, 1).g));
      nearest[k].push_back(static_cast<double>(radiance_nearest(map, surface, one, 256).g));
    }
  }
  const auto mean_cell = [maps](const std::vector<double>& values, double known) {
    double mean = 0;
    for (const double value : values)
      mean += value / maps;
    return carlo::interval_cell(mean, 1.96 * std::sqrt(split_error(values, known).variance / maps));
  };
  for (std::size_t k = 0; k < places.size(); ++k)
    table.add_row(
        {places[k].name, places[k].share, mean_cell(within[k], 1), mean_cell(nearest[k], 1)});
  notebook.table(
      "density_edges", table,
      "A floor that ends, of irradiance 1 up to its edge: the mean of many maps, with 95 "
      "% interval");
}

}  // namespace

void density_experiment(Notebook& notebook) {
  notebook.begin("Step e: radiance from photons");
  notebook.say(fmt::format(
      "The foot of a point light, where the irradiance is known, by maps of {} emitted photons. A "
      "large disc smears: the irradiance falls off around the foot, so the mean over a disc is too "
      "small. A small one has few photons.",
      carlo::count_text(emitted_below)));
  notebook.attempt([&] {
    const carlo::Chart radius = against_radius(notebook);
    notebook.progress(1, 3);
    notebook.charts({radius, against_count(notebook)});
    notebook.progress(2, 3);
    notebook.say(
        "Where a floor ends discs hang over its edge, and light is missing there however many "
        "photons there are. The nearest photons make the disc grow until it has k of them: it still "
        "hangs over.");
    at_edges(notebook);
  });
}

}  // namespace lab09
