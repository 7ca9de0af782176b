#include "course/report/format.h"
#include "course/report/stopwatch.h"
#include "course/viewer/tiles.h"
#include "experiments.h"
#include "images/views.h"
#include "photon_run.h"
#include "practice.h"
#include "shown_error.h"

#include <fmt/core.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

// Step g: the indirect light of the Cornell box, from a cache. Direct light is left out: it would
// be the same in both methods.

namespace lab09 {
namespace {

/// The hits of the camera's rays, the same for all images.
struct CachedView {
  explicit CachedView(int size) : view(lab08::cornell_box(), size) {
    for (int y = 0; y < size; ++y) {
      for (int x = 0; x < size; ++x)
        surfaces.push_back(view.world.intersect(view.ray(x, y)));
    }
  }

  lab08::View view;
  std::vector<std::optional<Surface>> surfaces;
};

struct CacheSetting {
  double most = 0.2;
  int strata = 8;
};

struct CachedImage {
  carlo::Image radiance, places;  ///< places: the same, darker, white where a record was made
  int records = 0;
};

CachedImage cached_image(const CachedView& seen, const CacheSetting& setting, Rng rng) {
  const World& world = seen.view.world;
  const int size = seen.view.size;
  Cache cache(setting.most, 0, INFINITY);
  CachedImage image{{size, size}, {size, size}, 0};
  for (std::size_t i = 0; i < seen.surfaces.size(); ++i) {
    const auto& surface = seen.surfaces[i];
    if (!surface) continue;
    const std::size_t before = cache.records().size();
    const Rgb E = cached_irradiance(cache, surface->p, surface->n, setting.most, [&] {
      return make_record(
          surface->p, surface->n, setting.strata,
          [&](Vec3 wi) { return indirect_arrival(world, world.leave(*surface, wi), rng); }, rng);
    });
    image.radiance.pixels[i] = surface->phong().kd / carlo::pi_f * E;
    const bool made = cache.records().size() > before;
    image.places.pixels[i] = made ? Rgb(1) : 0.4f * image.radiance.pixels[i];
  }
  image.records = static_cast<int>(cache.records().size());
  return image;
}

/// The same light by paths: one direction, and the radiance from there without emission.
Rgb indirect_path(const World& world, const Ray& ray, Rng& rng) {
  const auto surface = world.intersect(ray);
  if (!surface) return Rgb(0);
  const float u_lobe = rng.uniform_float();
  const float u = rng.uniform_float();
  const float v = rng.uniform_float();
  const auto next = lab08::sample(surface->phong(), surface->n, surface->wo, u_lobe, {u, v});
  if (!next) return Rgb(0);
  return next->weight * lab08::trace_specular(world, world.leave(*surface, next->wi), false, rng);
}

/// Several images of one setting.
struct CacheRun {
  CachedImage shown;
  ErrorParts parts;  ///< relative to the square of the reference's mean
  double records = 0, seconds = 0;

  double error() const { return total_error(parts); }
};

CacheRun cache_run(Notebook& notebook, const CachedView& seen, const lab08::Reference& reference,
                   const CacheSetting& setting) {
  const int repetitions = notebook.repetitions(8) + 2;
  const std::uint64_t seed = notebook.rng().next_u64();
  std::vector<CachedImage> images(static_cast<std::size_t>(repetitions));
  const carlo::Stopwatch watch;
  tbb::parallel_for(0, repetitions, [&](int i) {
    images[static_cast<std::size_t>(i)] =
        cached_image(seen, setting, Rng(seed, static_cast<std::uint64_t>(i)));
  });
  CacheRun run;
  run.seconds = watch.seconds() / repetitions;
  std::vector<carlo::Image> radiances;
  for (const CachedImage& image : images) {
    run.records += static_cast<double>(image.records) / repetitions;
    radiances.push_back(image.radiance);
  }
  run.parts = image_error(radiances, reference);
  run.shown = std::move(images.front());
  return run;
}

void add_cache_row(carlo::Table& table, const CacheSetting& setting, const CacheRun& run) {
  table.add_row({setting.most, setting.strata * setting.strata,
                 carlo::Cell(fmt::format("{:.0f}", run.records), run.records),
                 percent_of_root(run.parts.bias2, 2), percent_of_root(run.parts.variance, 2),
                 carlo::percent_cell(run.error(), 2), carlo::seconds_cell(run.seconds)});
}

constexpr double limits[] = {0.1, 0.2, 0.4, 0.8};

/// Error against time: for each limit a curve over the number of strata.
std::vector<Curve> cache_curves(Notebook& notebook, const CachedView& seen,
                                const lab08::Reference& reference, carlo::Table& table,
                                std::vector<std::string>& pictures, double white) {
  std::vector<Curve> curves;
  for (const double most : limits) {
    Curve curve{fmt::format("cache, most = {}", carlo::number_text(most)), {}};
    for (const int strata : {2, 4, 8, 16}) {
      // The finest cache with the most directions would take longer than all others together.
      if (most < 0.15 && strata > 8) continue;
      const CacheSetting setting{most, strata};
      const CacheRun run = cache_run(notebook, seen, reference, setting);
      curve.runs.push_back({static_cast<std::int64_t>(run.records),
                            lab08::mean_value(run.shown.radiance), run.error(), run.seconds});
      add_cache_row(table, setting, run);
      if (strata != 8 || most < 0.15) continue;
      pictures.push_back(carlo::image_tile(
          curve.name,
          fmt::format("{:.0f} records: error {}\u00a0%, {}", run.records,
                      carlo::number_text(100 * run.error(), 3), carlo::duration_text(run.seconds)),
          run.shown.radiance, white));
      if (most < 0.3)
        pictures.push_back(carlo::image_tile("where its records lie", "a white pixel each",
                                             run.shown.places, white));
    }
    curves.push_back(std::move(curve));
    notebook.progress(1 + static_cast<double>(curves.size()), 7);
  }
  return curves;
}

/// Images by 1, 4, 16 and 64 paths per pixel.
lab08::Result path_result(Notebook& notebook, const lab08::Reference& reference,
                          const lab08::SampledPixel& paths) {
  lab08::Result result{{"paths", {}}, {}, {}};
  for (const int samples : {1, 4, 16, 64}) {
    const std::uint64_t seed = notebook.rng().next_u64();
    const carlo::Stopwatch watch;
    carlo::Image image =
        lab08::render(reference.image.width, reference.image.height, seed,
                      [&](int x, int y, Rng& rng) { return paths(x, y, samples, rng); });
    result.curve.runs.push_back({samples, lab08::mean_value(image),
                                 lab08::relative_error(image, reference), watch.seconds()});
    if (samples > 16) continue;
    result.shown = std::move(image);
    result.shown_run = result.curve.runs.back();
  }
  return result;
}

}  // namespace

void irradiance_cache_experiment(Notebook& notebook) {
  notebook.begin("Step g: an irradiance cache");
  const CachedView seen(lab08::image_size(notebook, 128));
  const World& world = seen.view.world;
  notebook.attempt([&] {
    const auto paths = lab08::traced(
        seen.view, [&](const Ray& ray, Rng& rng) { return indirect_path(world, ray, rng); });
    const int many = lab08::most_samples(notebook) / 4, size = seen.view.size;
    const lab08::Reference reference = lab08::converged(notebook, size, size, many, paths);
    notebook.progress(1, 7);
    constexpr double white = 0.35;
    const lab08::Result traced = path_result(notebook, reference, paths);
    std::vector<std::string> pictures = lab08::pictures_of(
        reference, fmt::format("indirect light, {} paths a pixel", 2 * many), {traced}, white);
    carlo::Table table({"most", "directions", "records", "bias", "noise", "error", "time"},
                       {"most", "directions", "records", "bias", "noise", "error", "seconds"});
    std::vector<Curve> curves = cache_curves(notebook, seen, reference, table, pictures, white);
    notebook.say(
        "The indirect light of the Cornell box: by paths, and from caches with different error "
        "limits. A cache has two kinds of error: the noise of its records, which shows in the "
        "image as blotches, and the bias of using them elsewhere. More directions per record "
        "help only against the first.");
    notebook.raw_html(carlo::tiles(pictures));
    notebook.numbers("cache", table,
                     fmt::format("Caches: bias and noise apart, in parts of the mean radiance; {}",
                                 minus_is_noise));
    carlo::Table by_paths({"paths a pixel", "error", "time"}, {"paths", "error", "seconds"});
    for (const Measurement& run : traced.curve.runs)
      by_paths.add_row(
          {run.points, carlo::percent_cell(run.error, 2), carlo::seconds_cell(run.seconds)});
    notebook.data("indirect_paths", by_paths, "The same light by paths");
    curves.push_back(traced.curve);
    std::vector<carlo::Chart> charts =
        carlo::error_charts("Indirect light", "relative RMS error", curves, false);
    notebook.charts({charts[1]});
  });
}

}  // namespace lab09
