#include "course/report/format.h"
#include "course/report/stopwatch.h"
#include "course/viewer/tiles.h"
#include "experiments.h"
#include "photon_run.h"

#include <fmt/core.h>

#include <string>
#include <vector>

// Step f: pictures of a caustic, pass by pass: error against time beside lab 8's path tracer.

namespace lab09 {
namespace {

constexpr double image_alpha = 2 / 3.0, image_first_radius = 0.05;
constexpr std::int64_t photons_an_image = 20'000;

/// The mean of pictures with separate maps; `shrinks`: whether their discs shrink.
carlo::Image passes_image(const lab08::View& view, std::int64_t passes, bool shrinks,
                          std::uint64_t seed) {
  carlo::Image mean(view.size, view.size);
  double radius = image_first_radius;
  for (std::int64_t pass = 1; pass <= passes; ++pass) {
    const std::uint64_t pass_seed = Rng(seed, static_cast<std::uint64_t>(pass)).next_u64();
    const PhotonMap map = photon_map(view.world, photons_an_image, Kept::all, pass_seed);
    const lab08::SampledPixel pixel =
        on_floor(view, lab08::traced(view, [&](const Ray& ray, Rng& rng) {
                   return photon_radiance(view.world, ray, map, static_cast<float>(radius), rng);
                 }));
    const carlo::Image image =
        lab08::render(view.size, view.size, pass_seed,
                      [&](int x, int y, Rng& rng) { return pixel(x, y, 1, rng); });
    for (std::size_t i = 0; i < mean.pixels.size(); ++i)
      mean.pixels[i] += image.pixels[i] / static_cast<float>(passes);
    if (shrinks) radius = next_radius(radius, static_cast<int>(pass), image_alpha);
  }
  return mean;
}

/// As in lab08::measure(), with passes in place of samples.
lab08::Result measure_passes(Notebook& notebook, const std::string& name, const lab08::View& view,
                             const lab08::Reference& reference, bool shrinks) {
  lab08::Result result{{name, {}}, {}, {}};
  for (const std::int64_t passes : carlo::ladder(1, lab08::most_samples(notebook) / 4)) {
    const std::uint64_t seed = notebook.rng().next_u64();
    const carlo::Stopwatch watch;
    result.shown = passes_image(view, passes, shrinks, seed);
    result.shown_run = {passes, lab08::mean_value(result.shown),
                        lab08::relative_error(result.shown, reference), watch.seconds()};
    result.curve.runs.push_back(result.shown_run);
  }
  return result;
}

void image_passes(Notebook& notebook) {
  const lab08::View view(ball_of_glass(), lab08::image_size(notebook, 80));
  const int samples = 4 * lab08::most_samples(notebook);
  const lab08::SampledPixel paths = on_floor(view, lab08::tracer<carlo::IndependentSampler>(view));
  const lab08::Reference reference =
      lab08::converged(notebook, view.size, view.size, samples, paths);
  notebook.progress(1, 3);
  const std::vector<lab08::Result> results = {
      lab08::measure(notebook, "Lab 8.8", reference, 256, paths),
      measure_passes(notebook, "radius stays", view, reference, false),
      measure_passes(notebook, "radius shrinks", view, reference, true)};
  const double white = 3 * lab08::mean_value(reference.image);
  std::vector<std::string> tiles = {
      carlo::image_tile("reference", fmt::format("Lab 8.8, {} samples a pixel", 2 * samples),
                        reference.image, white)};
  for (const lab08::Result& r : results) {
    tiles.push_back(
        carlo::image_tile(r.curve.name,
                          fmt::format("{} {}: error {} %, {}", r.shown_run.points,
                                      &r == &results.front() ? "samples a pixel" : "passes",
                                      carlo::number_text(100 * r.shown_run.error, 3),
                                      carlo::duration_text(r.shown_run.seconds)),
                          r.shown, white));
  }
  notebook.raw_html(carlo::tiles(tiles));
  carlo::Table table = lab08::results_table();
  lab08::add_rows(table, "ball of glass", results);
  notebook.table("progressive_images", table,
                 "A caustic: error, cost and slopes; N is samples a pixel, or passes");
  std::vector<Curve> curves;
  for (const lab08::Result& r : results)
    curves.push_back(r.curve);
  std::vector<carlo::Chart> charts =
      carlo::error_charts("Ball of glass", "relative RMS error of the image", curves);
  notebook.charts({charts[1]});
}

}  // namespace

void progressive_image_experiment(Notebook& notebook) {
  notebook.begin("Step f: a caustic, pass by pass");
  notebook.say(fmt::format(
      "The ball of glass of step e by passes of {} photons each, all light from the map. Only "
      "one map is in memory at a time.",
      carlo::count_text(photons_an_image)));
  notebook.attempt([&] { image_passes(notebook); });
}

}  // namespace lab09
