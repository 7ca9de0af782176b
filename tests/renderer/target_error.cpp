// Does --target-error keep its promise, and what does it save over uniform sampling?

#include "course/cli/arguments.h"
#include "course/cli/main_guard.h"
#include "course/report/stopwatch.h"
#include "render/driver.h"
#include "render/scene_film.h"
#include "renderer/bench/spread.h"
#include "renderer/path_integrator.h"
#include "renderer/production/adaptive.h"
#include "scene/load_scene.h"
#include "support/error.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;
using bench::median;
using carlo::Scene;

/// Pixels per side of the tiles, the worst of which are compared.
constexpr int tile = 8;

/// 95 %, with an allowance for few seeds and for the noise of the mean that stands for the truth.
constexpr double promised = 0.93;

struct Arguments {
  std::string folder = "common/scenes";
  std::vector<std::string> scenes;
  double target = 0.1;
  int seeds = 8, size = 32, uniform_runs = 3;
  std::uint32_t spp = 1u << 20;
  std::uint64_t seed = 1;
};

double mean(const std::vector<double>& x) {
  double sum = 0;
  for (const double v : x)
    sum += v;
  return sum / static_cast<double>(x.size());
}

/// Luminance of each pixel.
using Grey = std::vector<double>;

Grey grey(const carlo::Film& film) {
  Grey result;
  for (int y = 0; y < film.height(); ++y) {
    for (int x = 0; x < film.width(); ++x)
      result.push_back(
          carlo::luminance({film.mean(x, y, 0), film.mean(x, y, 1), film.mean(x, y, 2)}));
  }
  return result;
}

struct Run {
  Grey image;
  double seconds = 0;
  carlo::AdaptiveSummary summary;
};

/// One render on one thread: adaptive, or uniform with `spp` samples a pixel.
Run render(const Scene& scene, std::uint64_t seed, std::uint32_t spp,
           std::optional<double> target) {
  const auto integrator = renderer::make_path_integrator(
      scene, {.seed = seed, .spp = target ? carlo::adaptive_strata : spp});
  const carlo::Stopwatch stopwatch;
  if (!target) {
    const carlo::RenderResult result = carlo::render(*integrator, scene.width, scene.height,
                                                     {.spp = spp, .threads = 1, .progress = false});
    return {grey(result.film), stopwatch.seconds(), {}};
  }
  const carlo::AdaptiveResult result =
      carlo::render_adaptively(*integrator, scene.width, scene.height, {*target, spp, {}},
                               {.threads = 1, .progress = false});
  return {grey(result.film), stopwatch.seconds(), result.summary};
}

/// Errors of luminance relative to the truth, or to 1 % of its mean if that is more.
struct Errors {
  double within = 0;      ///< fraction of the pixels within the target
  double worst_tile = 0;  ///< the largest root mean square over a tile
};

Errors errors(const Grey& image, const Grey& truth, int size, double target) {
  const double floor = 0.01 * mean(truth);
  Errors result;
  for (int y0 = 0; y0 < size; y0 += tile) {
    for (int x0 = 0; x0 < size; x0 += tile) {
      double sum = 0, count = 0;
      for (int y = y0; y < std::min(y0 + tile, size); ++y) {
        for (int x = x0; x < std::min(x0 + tile, size); ++x) {
          const auto i = static_cast<std::size_t>(y * size + x);
          const double e = (image[i] - truth[i]) / std::fmax(truth[i], floor);
          sum += e * e;
          ++count;
          result.within += std::abs(e) <= target ? 1 : 0;
        }
      }
      result.worst_tile = std::fmax(result.worst_tile, std::sqrt(sum / count));
    }
  }
  result.within /= static_cast<double>(truth.size());
  return result;
}

/// The results of the adaptive renders of a scene.
struct Adaptive {
  std::vector<double> within, expected, worst_tile, seconds;
  carlo::AdaptiveSummary example;
  Grey truth;  ///< their mean: unbiased, and better than each by the root of their number
};

Adaptive measure(const Scene& scene, const Arguments& a) {
  std::vector<Run> runs;
  for (int i = 0; i < a.seeds; ++i)
    runs.push_back(render(scene, a.seed + static_cast<std::uint64_t>(i), a.spp, a.target));
  Adaptive result;
  result.example = runs[0].summary;
  Grey sum(runs[0].image.size());
  for (const Run& run : runs) {
    for (std::size_t i = 0; i < sum.size(); ++i)
      sum[i] += run.image[i];
  }
  for (const Run& run : runs) {
    Grey others = sum;  // excludes the render itself, which cannot judge itself
    for (std::size_t i = 0; i < sum.size(); ++i)
      others[i] = (sum[i] - run.image[i]) / (a.seeds - 1);
    const Errors e = errors(run.image, others, a.size, a.target);
    result.within.push_back(e.within);
    result.worst_tile.push_back(e.worst_tile);
    result.expected.push_back(run.summary.within);
    result.seconds.push_back(run.seconds);
  }
  result.truth = sum;
  for (double& x : result.truth)
    x /= a.seeds;
  return result;
}

struct Uniform {
  double spp = 0, seconds = 0;
};

/// The samples per pixel and the time that a uniform render needs for the same worst tile:
/// interpolated between two powers of two, on a straight line of logarithms.
Uniform same_worst_tile(const Scene& scene, const Adaptive& adaptive, const Arguments& a) {
  const double goal = median(adaptive.worst_tile);
  double last_spp = 0, last_seconds = 0, last_worst = 0;
  for (std::uint32_t spp = 16;; spp *= 2) {
    std::vector<double> worst, seconds;
    for (int i = 0; i < a.uniform_runs; ++i) {
      const Run run = render(scene, a.seed + 1'000'000 + static_cast<std::uint64_t>(i), spp, {});
      worst.push_back(errors(run.image, adaptive.truth, a.size, a.target).worst_tile);
      seconds.push_back(run.seconds);
    }
    const double now = median(worst), time = median(seconds);
    if (now <= goal && last_spp == 0) return {static_cast<double>(spp), time};
    if (now <= goal) {
      const double t = std::log(last_worst / goal) / std::log(last_worst / now);
      return {last_spp * std::pow(spp / last_spp, t),
              last_seconds * std::pow(time / last_seconds, t)};
    }
    if (spp >= a.spp) {
      throw carlo::Error("uniform sampling does not reach the same worst tile with {} samples",
                         spp);
    }
    last_spp = spp, last_seconds = time, last_worst = now;
  }
}

/// Prints the scene's row; returns the fraction of the pixels within the target.
double measure_scene(const fs::path& file, const Arguments& a) {
  Scene scene = carlo::load_scene(file);
  carlo::resize(scene, a.size, a.size);
  const Adaptive adaptive = measure(scene, a);
  const Uniform uniform = same_worst_tile(scene, adaptive, a);
  const double seconds = median(adaptive.seconds);
  const auto& s = adaptive.example;
  fmt::print(
      "{:<20} {:>6.1f} {:>6.1f} {:>8.1f} {:>6.1f} {:>7} {:>7} {:>8} {:>9.4f} {:>9.3f} {:>9.0f} "
      "{:>9.3f} {:>6.2f}\n",
      file.stem().string(), 100 * mean(adaptive.within),
      100 * *std::min_element(adaptive.within.begin(), adaptive.within.end()),
      100 * mean(adaptive.expected), 100 * s.capped, s.least, s.median, s.most,
      median(adaptive.worst_tile), seconds, uniform.spp, uniform.seconds,
      uniform.seconds / seconds);
  std::fflush(stdout);
  return mean(adaptive.within);
}

int run(const Arguments& a) {
  std::vector<fs::path> files(a.scenes.begin(), a.scenes.end());
  if (files.empty()) {
    files = {fs::path(a.folder) / "partial_occluders.xml", fs::path(a.folder) / "caustics.xml"};
  }
  fmt::print(
      "target {:.3g} % of a pixel at 95 % confidence, {} x {} pixels, {} seeds, one thread; "
      "medians\n"
      "within: % of the pixels within the target (mean, worst seed; expected by the reports)\n"
      "uniform: samples and processor seconds for the same error in the worst tile of {} x {}\n",
      100 * a.target, a.size, a.size, a.seeds, tile, tile);
  fmt::print("{:<20} {:>6} {:>6} {:>8} {:>6} {:>7} {:>7} {:>8} {:>9} {:>9} {:>9} {:>9} {:>6}\n",
             "scene", "within", "worst", "expected", "capped", "spp min", "median", "max", "tile",
             "CPU s", "uniform", "CPU s", "ratio");
  std::fflush(stdout);
  double least = 1;
  for (const fs::path& file : files)
    least = std::min(least, measure_scene(file, a));
  if (least >= promised) return 0;
  throw carlo::Error("{:.3g} % of the pixels are within the target, fewer than {:.3g} %",
                     100 * least, 100 * promised);
}

}  // namespace

int main(int argc, char** argv) {
  return carlo::run_main([&] {
    Arguments a;
    carlo::CommandLine app(
        "Renders scenes with --target-error and many seeds: how many pixels are within the target, "
        "and how long uniform sampling takes to the same error in the worst tile. What is true is "
        "the mean of all renders but the one on trial.",
        "carlo_target_error");
    app.option("--scene", a.scenes, "scene files (default: partial occluders and caustics)")
        .existing_file();
    app.option("--folder", a.folder, "folder of scenes").existing_folder().show_default();
    app.option("--target", a.target, "relative error of a pixel").range(1e-6, 0.999).show_default();
    app.option("--seeds", a.seeds, "adaptive renders of a scene").range(2, 10000).show_default();
    app.option("--size", a.size, "side of the film in pixels").range(1, 4096).show_default();
    app.option("--spp", a.spp, "samples a pixel at most").range(32u, 1u << 28).show_default();
    app.option("--seed", a.seed, "the first seed").show_default();
    if (const auto code = app.parse(argc, argv)) return *code;
    return run(a);
  });
}
