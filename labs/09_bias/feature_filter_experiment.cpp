#include "course/report/format.h"
#include "course/report/stopwatch.h"
#include "course/viewer/tiles.h"
#include "practice.h"
#include "shown_error.h"

#include <fmt/core.h>

#include <algorithm>

// Step c: soft shadows by few paths, filtered. No feature shows the edge of a shadow.

namespace lab09 {
namespace {

struct FilterSetting {
  const char* name;
  double k;  ///< 0: not filtered
};
constexpr FilterSetting filter_settings[] = {
    {"paths", 0}, {"filtered, k = 1", 1}, {"filtered, k = 4", 4}, {"by features alone", 1e6}};

/// The result of one setting for images of this many samples.
struct FilterRun {
  ErrorParts parts;
  double seconds = 0;  ///< of all processors together, for paths and filter
  carlo::Image shown;

  double error() const { return total_error(parts); }
};

carlo::Image color_of(const FeatureImage& noisy) {
  carlo::Image image(noisy.width(), noisy.height());
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x)
      image.at(x, y) = noisy.at(x, y).color;
  }
  return image;
}

/// All settings, on the same noisy images.
std::vector<FilterRun> filter_runs(Notebook& notebook, const PracticeScene& scene, int samples) {
  const int repetitions = notebook.repetitions(8) + 2;
  std::vector<FilterRun> runs(std::size(filter_settings));
  std::vector<std::vector<carlo::Image>> images(runs.size());
  for (int i = 0; i < repetitions; ++i) {
    const carlo::Stopwatch watch;
    const FeatureImage noisy = noisy_image(scene, samples, notebook.rng().next_u64());
    const double traced = watch.seconds();
    for (std::size_t k = 0; k < runs.size(); ++k) {
      const FilterSetting& setting = filter_settings[k];
      const carlo::Stopwatch filtering;
      FilterStrength strength;
      strength.color = setting.k;
      images[k].push_back(setting.k > 0 ? filtered_image(noisy, strength) : color_of(noisy));
      runs[k].seconds += (traced + (setting.k > 0 ? filtering.seconds() : 0)) / repetitions;
    }
  }
  for (std::size_t k = 0; k < runs.size(); ++k) {
    runs[k].parts = practice_parts(scene, images[k]);
    runs[k].shown = std::move(images[k].front());
  }
  return runs;
}

void add_filter_pictures(Notebook& notebook, const PracticeScene& scene, int samples,
                         const std::vector<FilterRun>& runs) {
  constexpr double white = 1;
  std::vector<std::string> row = {
      carlo::image_tile("reference", scene.name, scene.reference, white)};
  for (std::size_t k = 0; k < runs.size(); ++k) {
    row.push_back(carlo::image_tile(filter_settings[k].name,
                                    fmt::format("{} samples: error {}\u00a0%", samples,
                                                carlo::number_text(100 * runs[k].error(), 2)),
                                    runs[k].shown, white));
  }
  notebook.raw_html(carlo::tiles(row));
}

}  // namespace

void feature_filter_experiment(Notebook& notebook) {
  notebook.begin("Step c: a filter that knows edges");
  notebook.attempt([&] {
    const PracticeScene scene("soft_shadows", notebook.options().quick ? 32 : 64);
    carlo::Table table({"samples", "image", "bias", "noise", "error", "time"},
                       {"samples", "image", "bias", "noise", "error", "seconds"});
    std::vector<Curve> curves;
    for (const FilterSetting& setting : filter_settings)
      curves.push_back({setting.name, {}});
    const std::vector<int> sample_counts = {4, 16, 64, 256};
    for (std::size_t i = 0; i < sample_counts.size(); ++i) {
      const int samples = sample_counts[i];
      const std::vector<FilterRun> runs = filter_runs(notebook, scene, samples);
      for (std::size_t k = 0; k < runs.size(); ++k) {
        const FilterRun& run = runs[k];
        table.add_row({samples, filter_settings[k].name, percent_of_root(run.parts.bias2, 2),
                       percent_of_root(run.parts.variance, 2),
                       percent_of_root(run.parts.bias2 + run.parts.variance, 2),
                       carlo::seconds_cell(run.seconds)});
        curves[k].runs.push_back({samples, 0, run.error(), run.seconds});
      }
      if (samples == 16) add_filter_pictures(notebook, scene, samples, runs);
      notebook.progress(static_cast<double>(i + 1), static_cast<double>(sample_counts.size()));
    }
    notebook.say(
        "The soft shadows of a room by lab 8's paths, and the same images filtered. Bias and noise "
        "are relative, dark pixels counted as .1. Albedo, normal and depth show corners and "
        "the balls' outlines, but not a shadow's edge: that is left to the colours, and k says "
        "how many standard errors they may differ by.");
    notebook.numbers("filter", table,
                     fmt::format("Filtered and not: bias and noise apart; {}", minus_is_noise));
    notebook.charts({carlo::error_charts("Soft shadows", "relative RMS error", curves, false)[1]});
  });
}

}  // namespace lab09
