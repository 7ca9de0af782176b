#include "course/report/stopwatch.h"
#include "course/viewer/tiles.h"
#include "experiments.h"
#include "images/views.h"

#include <algorithm>
#include <cmath>

// Step h: the path tracer beside the earlier steps, at equal time, and what its points gain.

namespace lab08 {
namespace {

using carlo::IndependentSampler, carlo::SobolSampler, carlo::StratifiedSampler;

struct TracedMethod {
  std::string name;
  SampledPixel pixel;
};

std::vector<TracedMethod> methods(const View& view) {
  const World& world = view.world;
  return {
      {"TracePath, 8.4",
       traced(view, [&world](const Ray& ray, Rng& rng) { return trace_path(world, ray, rng); })},
      {"lights by area, 8.6",
       traced(view,
              [&world](const Ray& ray, Rng& rng) { return trace_direct(world, ray, true, rng); })},
      {"8.8, independent", tracer<IndependentSampler>(view)},
      {"8.8, stratified", tracer<StratifiedSampler>(view)},
      {"8.8, Sobol'", tracer<SobolSampler>(view)}};
}

/// Each method with as many samples as it can take in the time of 16 samples of the last one.
std::string equal_time(Notebook& notebook, const View& view,
                       const std::vector<TracedMethod>& methods, const std::vector<Result>& results,
                       const Reference& reference, double white) {
  const double seconds = 16 * results.back().seconds_a_sample();
  std::vector<Result> shown;
  for (std::size_t i = 0; i < results.size(); ++i) {
    const int samples =
        std::max(1, static_cast<int>(std::lround(seconds / results[i].seconds_a_sample())));
    Result result{{results[i].curve.name, {}}, {}, {}};
    const std::uint64_t seed = notebook.rng().next_u64();
    const carlo::Stopwatch watch;
    result.shown = render(view.size, view.size, seed, [&](int x, int y, Rng& rng) {
      return methods[i].pixel(x, y, samples, rng);
    });
    const double spent = watch.seconds();
    result.shown_run = {samples, 0, relative_error(result.shown, reference), spent};
    shown.push_back(std::move(result));
  }
  return carlo::tiles(
      pictures_of(reference, fmt::format("{} Sobol' points a pixel", 2 * most_samples(notebook)),
                  shown, white));
}

void show(Notebook& notebook, const std::string& scene, const View& view, double white,
          carlo::Table& table) {
  const std::vector<TracedMethod> all = methods(view);
  const Reference reference =
      converged(notebook, view.size, view.size, most_samples(notebook), all.back().pixel);
  std::vector<Result> results;
  for (const TracedMethod& method : all) {
    results.push_back(measure(notebook, method.name, reference, 16, method.pixel));
    notebook.progress(static_cast<double>(results.size()), static_cast<double>(all.size()));
  }
  notebook.raw_html(equal_time(notebook, view, all, results, reference, white));
  add_rows(table, scene, results);
  add_charts(notebook, scene, results);
}

}  // namespace

void tracer_experiment(Notebook& notebook) {
  notebook.begin("Step h: the path tracer");
  notebook.attempt([&] {
    carlo::Table table = results_table();
    notebook.say(
        "The Cornell box by the tracers of steps d, f and h, each with as many samples as the time "
        "of 16 Sobol' samples allows. Then four plates, more polished one by one, that mirror four "
        "lights of falling size and equal power: on the rough plates points of the lights are the "
        "better samples, on the polished ones sample()'s directions, and the path tracer takes "
        "both.");
    show(notebook, "Cornell box", View(cornell_box(), image_size(notebook, 64)), 1.2, table);
    show(notebook, "plates", View(plates(), image_size(notebook, 96)), 0.8, table);
    notebook.table("tracer", table, "Tracers and samplers: error, cost and slopes");
  });
}

}  // namespace lab08
