#include "course/report/format.h"
#include "course/report/stopwatch.h"
#include "course/viewer/tiles.h"
#include "experiments.h"
#include "photon_run.h"
#include "shown_error.h"

#include <fmt/core.h>

#include <functional>
#include <string>
#include <vector>

// Step e: a caustic by photons beside lab 8's path tracer, in about the same time.

namespace lab09 {
namespace {

using carlo::IndependentSampler;

/// Makes an image; each seed gives a different one.
struct Renderer {
  std::string name, note;
  std::function<carlo::Image(std::uint64_t seed)> render;
};

carlo::Image floor_image(const lab08::View& view, int samples, std::uint64_t seed,
                         const lab08::SampledPixel& pixel) {
  const lab08::SampledPixel floor = on_floor(view, pixel);
  return lab08::render(view.size, view.size, seed,
                       [&](int x, int y, Rng& rng) { return floor(x, y, samples, rng); });
}

using WithMap = Rgb (*)(const World&, const Ray&, const PhotonMap&, float, Rng&);

/// Traces photons, then makes a picture from them.
Renderer by_photons(const lab08::View& view, const std::string& name, WithMap radiance, Kept kept,
                    std::int64_t emitted, float radius, int samples) {
  return {name, fmt::format("{} photons, radius {:g}", carlo::count_text(emitted), radius),
          [=, &view](std::uint64_t seed) {
            const PhotonMap map = photon_map(view.world, emitted, kept, seed);
            return floor_image(view, samples, seed,
                               lab08::traced(view, [&](const Ray& ray, Rng& rng) {
                                 return radiance(view.world, ray, map, radius, rng);
                               }));
          }};
}

std::vector<Renderer> renderers(const Notebook& notebook, const lab08::View& view) {
  const int samples = notebook.options().quick ? 8 : 32;
  const std::int64_t emitted = notebook.options().n / 4;
  return {{"Lab 8.8", fmt::format("{} samples a pixel", 2 * samples),
           [&view, samples](std::uint64_t seed) {
             return floor_image(view, 2 * samples, seed, lab08::tracer<IndependentSampler>(view));
           }},
          by_photons(view, "all by photons, large discs", photon_radiance, Kept::all, emitted,
                     0.15f, 1),
          by_photons(view, "all by photons", photon_radiance, Kept::all, emitted, 0.03f, 1),
          by_photons(view, "caustics by photons", caustic_radiance, Kept::caustics, emitted, 0.03f,
                     samples / 2)};
}

void compare(Notebook& notebook) {
  const lab08::View view(ball_of_glass(), lab08::image_size(notebook, 80));
  const int samples = 4 * lab08::most_samples(notebook);
  const lab08::Reference reference =
      lab08::converged(notebook, view.size, view.size, samples,
                       on_floor(view, lab08::tracer<IndependentSampler>(view)));
  notebook.progress(1, 2);
  const int runs = notebook.options().quick ? 4 : 8;
  const double white = 3 * lab08::mean_value(reference.image);
  carlo::Table table({"method", "how many", "bias", "noise", "both", "time of one"},
                     {"method", "how_many", "bias", "noise", "error", "seconds"});
  std::vector<std::string> tiles = {
      carlo::image_tile("reference", fmt::format("Lab 8.8, {} samples a pixel", 2 * samples),
                        reference.image, white)};
  const auto percent = [](double square) { return percent_of_root(square, 3); };
  for (const Renderer& renderer : renderers(notebook, view)) {
    std::vector<carlo::Image> images;
    const carlo::Stopwatch watch;
    for (int i = 0; i < runs; ++i)
      images.push_back(renderer.render(notebook.rng().next_u64()));
    const double seconds = watch.seconds() / runs;
    const ErrorParts parts = image_error(images, reference);
    table.add_row({renderer.name, renderer.note, percent(parts.bias2), percent(parts.variance),
                   percent(parts.bias2 + parts.variance), carlo::seconds_cell(seconds)});
    tiles.push_back(carlo::image_tile(
        renderer.name, fmt::format("{}: {}", renderer.note, carlo::duration_text(seconds)),
        images[0], white));
  }
  notebook.raw_html(carlo::tiles(tiles));
  notebook.table("caustic", table,
                 fmt::format("The error of a pixel, over the mean of the reference: bias and noise "
                             "from {} pictures of each; {}",
                             runs, minus_is_noise));
}

}  // namespace

void caustic_experiment(Notebook& notebook) {
  notebook.begin("Step e: a caustic");
  notebook.say(
      "A ball of glass gathers the light of a small light source on the floor. Paths from the "
      "camera have to find that light through the ball; photons reach the floor directly. "
      "Photons alone blur all shadows, too; a map of caustics leaves the rest to paths. The ball "
      "itself is left black: what is seen in it is equally noisy with all methods.");
  notebook.attempt([&] { compare(notebook); });
}

}  // namespace lab09
