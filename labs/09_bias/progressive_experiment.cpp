#include "course/report/format.h"
#include "experiments.h"
#include "given/sampled.h"
#include "mirrored_light.h"
#include "photon_run.h"
#include "sampling/samplers.h"
#include "shown_error.h"

#include <fmt/core.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

// Step f: three points of a floor that is lit only via a mirror, in closed form: how fast errors
// fall with discs that shrink, with others that do not, and with paths.

namespace lab09 {
namespace {

using carlo::IndependentSampler;

constexpr double shrinking_alpha = 2 / 3.0, widest = 0.4;
constexpr std::int64_t photons_a_map = 512;

/// The photons that come to the floor directly from the mirror.
PhotonMap pass_map(const World& world, Rng& rng) {
  return photon_map(world, photons_a_map, Kept::caustics, rng);
}

/// The three points by a map, one channel each.
Rgb at_points(const MirroredLight& light, const PhotonMap& map, double radius) {
  Rgb radiances(0);
  for (int i = 0; i < 3; ++i) {
    const auto surface = light.world.intersect(light.ray(i));
    const auto f = [&](Vec3 wi) {
      return lab08::evaluate(surface->phong(), surface->n, surface->wo, wi);
    };
    radiances[i] = radiance_within(map, *surface, f, static_cast<float>(radius)).g;
  }
  return radiances;
}

/// An estimate of all three points from this many passes, or samples.
using Points = std::function<Rgb(const MirroredLight& light, std::int64_t n, Rng& rng)>;

Rgb progressive(const MirroredLight& light, std::int64_t passes, Rng& rng) {
  return progressive_mean(
      static_cast<int>(passes), widest, shrinking_alpha,
      [&](int, double radius) { return at_points(light, pass_map(light.world, rng), radius); });
}

Rgb unshrunk(const MirroredLight& light, std::int64_t passes, Rng& rng) {
  glm::dvec3 sum(0);
  for (std::int64_t i = 0; i < passes; ++i)
    sum += at_points(light, pass_map(light.world, rng), widest);
  return sum / static_cast<double>(passes);
}

/// Paths of floor, mirror and light.
Rgb by_paths(const MirroredLight& light, std::int64_t samples, Rng& rng) {
  constexpr int segments = 3;
  glm::dvec3 sum(0);
  for (int i = 0; i < 3; ++i) {
    carlo::SampleId id{rng.next_u64(), 0, 0, static_cast<std::uint32_t>(samples)};
    for (std::int64_t k = 0; k < samples; ++k, ++id.index) {
      lab08::Sampled<IndependentSampler> dimensions(id);
      sum[i] +=
          static_cast<double>(path_radiance(light.world, light.ray(i), segments, dimensions).g);
    }
  }
  return sum / static_cast<double>(samples);
}

struct Method {
  std::string name;
  Points points;
  double light_radius;
  std::int64_t first, last;
  std::string expected;  ///< the slope, as text
};

/// Errors against passes, or samples: relative bias^2 and variance.
struct Falling {
  std::vector<double> n, error;
  std::vector<ErrorParts> parts;
};

Falling falling(Notebook& notebook, const Method& method) {
  const MirroredLight light(method.light_radius);
  const auto runs = static_cast<std::size_t>(notebook.repetitions(48));
  Falling all;
  for (const std::int64_t n : carlo::ladder(method.first, method.last)) {
    std::vector<double> estimates(3 * runs);
    const std::uint64_t seed = notebook.rng().next_u64();
    tbb::parallel_for(std::size_t{0}, runs, [&](std::size_t run) {
      Rng rng(seed, run);
      const Rgb points = method.points(light, n, rng);
      for (int i = 0; i < 3; ++i)
        estimates[3 * run + static_cast<std::size_t>(i)] =
            static_cast<double>(points[i]) / light.exact();
    });
    const ErrorParts parts = split_error(estimates, 1);
    all.n.push_back(static_cast<double>(n));
    all.parts.push_back(parts);
    all.error.push_back(std::sqrt(std::max(parts.bias2 + parts.variance, 1e-12)));
  }
  return all;
}

void slopes(Notebook& notebook) {
  const std::int64_t passes = notebook.options().n / 4096, samples = notebook.options().n / 16;
  const std::vector<Method> methods = {
      {"radius stays", unshrunk, 0.02, 1, passes, "0 in the end"},
      {"radius shrinks", progressive, 0.02, 1, passes, "-1/3"},
      {"Lab 8.8", by_paths, 0.02, 1024, samples, "-1/2"},
      {"radius shrinks, light a hundredth the area", progressive, 0.002, 1, passes, "-1/3"},
      {"Lab 8.8, light a hundredth the area", by_paths, 0.002, 1024, samples,
       "-1/2 once it is found"}};
  carlo::Chart chart{"Error of a point's radiance",
                     fmt::format("a pass has {} photons", photons_a_map),
                     {"passes, or samples of the point"},
                     {"relative error"},
                     {}};
  carlo::Table table(
      {"method", "passes or samples", "bias", "noise", "slope, second half", "theory"},
      {"method", "n", "bias", "noise", "slope", "expected"});
  carlo::Table data({"method", "n", "bias²", "variance"}, {"method", "n", "bias2", "variance"});
  for (const Method& method : methods) {
    const Falling all = falling(notebook, method);
    carlo::Series series{method.name, {}};
    for (std::size_t i = 0; i < all.n.size(); ++i) {
      series.points.push_back({all.n[i], all.error[i]});
      data.add_row({method.name, all.n[i], all.parts[i].bias2, all.parts[i].variance});
    }
    chart.series.push_back(series);
    const std::size_t half = all.n.size() / 2;
    const double slope =
        fitted_slope(std::span(all.n).subspan(half), std::span(all.error).subspan(half));
    table.add_row(
        {method.name,
         carlo::Cell(carlo::count_text(static_cast<std::int64_t>(all.n.back())), all.n.back()),
         percent_of_root(all.parts.back().bias2, 3), percent_of_root(all.parts.back().variance, 3),
         carlo::number_cell(slope, 2), method.expected});
    notebook.progress(static_cast<double>(chart.series.size()),
                      static_cast<double>(methods.size()));
  }
  notebook.charts({chart});
  notebook.table(
      "progressive", table,
      fmt::format("The largest number of passes or samples of each; slopes by fitted_slope(); {}",
                  minus_is_noise));
  notebook.data("progressive_errors", data, "All errors, over the square of the exact value");
}

}  // namespace

void progressive_experiment(Notebook& notebook) {
  notebook.begin("Step f: ever smaller discs");
  notebook.say(
      "A round light that faces up, a mirror above it, a floor below: points of the floor see the "
      "light in the mirror alone, and their radiance has a closed form. Every photon comes by the "
      "mirror; a path has to find the light, the longer the smaller it is.");
  notebook.attempt([&] { slopes(notebook); });
}

}  // namespace lab09
