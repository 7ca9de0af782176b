#include "course/report/format.h"
#include "course/report/stopwatch.h"
#include "course/viewer/tiles.h"
#include "experiments.h"
#include "images/views.h"
#include "numeric/robust.h"

#include <fmt/core.h>

#include <cmath>
#include <string>
#include <vector>

// Step f: the Cornell box.

namespace lab08 {
namespace {

/// A single reflection.
Rgb direct_only(const World& world, const Ray& ray, Rng& rng) {
  const auto surface = world.intersect(ray);
  if (!surface) return world.environment();
  const Brdf f = [&](Vec3 wi) { return evaluate(surface->phong(), surface->n, surface->wo, wi); };
  return surface->Le + direct_by_area(world, *surface, f, rng);
}

carlo::Image difference(carlo::Image a, const carlo::Image& b) {
  for (std::size_t i = 0; i < a.pixels.size(); ++i)
    a.pixels[i] = glm::max(a.pixels[i] - b.pixels[i], Rgb(0));
  return a;
}

/// Paths per pixel of the two pictures with which the lecture shows that noise decreases slowly.
constexpr int few = 40;
int many_more(const Notebook& notebook) {
  return notebook.options().quick ? 300 : 1200;
}

std::vector<std::string> forty_and_many(Notebook& notebook, const Reference& reference,
                                        const SampledPixel& pixel, double white) {
  std::vector<std::string> row;
  for (const int samples : {few, many_more(notebook)}) {
    const carlo::Stopwatch watch;
    const carlo::Image image =
        render(reference.image.width, reference.image.height, notebook.rng().next_u64(),
               [&](int x, int y, Rng& rng) { return pixel(x, y, samples, rng); });
    const double seconds = watch.seconds();
    row.push_back(
        carlo::image_tile(fmt::format("{} paths a pixel", samples),
                          fmt::format("error {}\u00a0%, {}",
                                      carlo::number_text(100 * relative_error(image, reference), 3),
                                      carlo::duration_text(seconds)),
                          image, white));
  }
  return row;
}

}  // namespace

void indirect_experiment(Notebook& notebook) {
  notebook.begin("Step f: indirect light");
  const View view(cornell_box(), image_size(notebook, 64));
  const World& world = view.world;
  notebook.attempt([&] {
    const auto with_direct =
        traced(view, [&](const Ray& ray, Rng& rng) { return trace_direct(world, ray, true, rng); });
    const int many = most_samples(notebook);
    const Reference reference = converged(notebook, view.size, view.size, many, with_direct);
    notebook.progress(1, 3);
    const auto one_bounce =
        traced(view, [&](const Ray& ray, Rng& rng) { return direct_only(world, ray, rng); });
    const Reference direct = converged(notebook, view.size, view.size, many, one_bounce);
    std::vector<Result> results;
    results.push_back(measure(notebook, "lights by area, 8.6", reference, 16, with_direct));
    notebook.progress(2, 3);
    notebook.attempt([&] {
      results.push_back(measure(
          notebook, "TracePath, 8.4", reference, 16,
          traced(view, [&](const Ray& ray, Rng& rng) { return trace_path(world, ray, rng); })));
    });
    notebook.say(
        "The Cornell box. Light straight from the light source, light via other surfaces, and "
        "both. Lab 8.4's paths have to meet the light by chance; Lab 8.6 samples it at each "
        "vertex. The reference is a long run of Lab 8.6; its own error is subtracted.");
    constexpr double white = 1.2;
    std::vector<std::string> row =
        pictures_of(reference, fmt::format("direct and indirect, {} samples a pixel", 2 * many),
                    results, white);
    row.push_back(carlo::image_tile("direct", "one reflection", direct.image, white));
    row.push_back(carlo::image_tile("indirect", "all the rest",
                                    difference(reference.image, direct.image), white));
    notebook.raw_html(carlo::tiles(row));
    carlo::Table table = results_table();
    add_rows(table, "Cornell box", results);
    notebook.table("indirect", table, "The Cornell box: error, cost and slopes");
    add_charts(notebook, "Cornell box", results);
    notebook.attempt([&] {
      const auto pictures = forty_and_many(
          notebook, reference,
          traced(view, [&](const Ray& ray, Rng& rng) { return trace_path(world, ray, rng); }),
          white);
      const double times = static_cast<double>(many_more(notebook)) / few;
      notebook.say(
          fmt::format("The lecture's two pictures, by its corrected TracePath: {:.2g} times the "
                      "paths, and {:.2g} times less noise.",
                      times, std::sqrt(times)));
      notebook.raw_html(carlo::tiles(pictures));
    });
  });
}

}  // namespace lab08
