// `./carlo bench target-error`: does adaptive sampling keep its promise, and what does it save?

#include "cli/arguments.h"
#include "cli/error.h"
#include "cli/main_guard.h"
#include "cli/progress.h"
#include "image/metrics.h"
#include "render/driver.h"
#include "render/half_sums.h"
#include "render/render_app.h"
#include "renderer/path_integrator.h"
#include "scene/load_scene.h"

#include <CLI/CLI.hpp>
#include <fmt/core.h>
#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;
using carlo::Scene;

constexpr int tile = 8;

struct Arguments {
  std::string folder = "common/scenes";
  std::vector<std::string> scenes;
  double target = 0.05;
  int seeds = 4, size = 32;
  std::uint32_t spp = 1u << 16;
  std::uint64_t seed = 1;
  int threads = 1;
};

/// Processor seconds of this program so far, all threads.
double processor_seconds() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_utime.tv_sec) +
         1e-6 * static_cast<double>(usage.ru_utime.tv_usec);
}

double median(std::vector<double> x) {
  std::sort(x.begin(), x.end());
  return x[x.size() / 2];
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
  double seconds = 0, samples = 0;
  carlo::RenderResult result;
};

Run render(const Scene& scene, const Arguments& a, std::uint64_t seed, std::uint32_t spp,
           bool adaptive) {
  const auto integrator = renderer::make_path_integrator(
      scene, {.seed = seed, .spp = adaptive ? carlo::adaptive_strata : spp});
  const double before = processor_seconds();
  carlo::RenderOptions options{.spp = spp, .seconds = {}, .threads = a.threads, .progress = false};
  if (adaptive) options.target_error = a.target;
  carlo::RenderResult result =
      carlo::render(*integrator, scene.width, scene.height, carlo::radiance_scale(scene), options);
  const double seconds = processor_seconds() - before;
  return {grey(result.film), seconds,
          static_cast<double>(result.film.samples()) / (1.0 * scene.width * scene.height),
          std::move(result)};
}

/// Errors of luminance relative to the truth, or to 1 % of its mean where that is more.
struct Errors {
  double within = 0;      ///< fraction of the pixels within the target
  double worst_tile = 0;  ///< the largest root mean square over a tile
};

Errors errors(const Grey& image, const Grey& truth, int size, double target) {
  double mean = 0;
  for (const double t : truth)
    mean += t / static_cast<double>(truth.size());
  Errors result;
  for (int y0 = 0; y0 < size; y0 += tile) {
    for (int x0 = 0; x0 < size; x0 += tile) {
      double sum = 0, count = 0;
      for (int y = y0; y < std::min(y0 + tile, size); ++y) {
        for (int x = x0; x < std::min(x0 + tile, size); ++x) {
          const auto i = static_cast<std::size_t>(y * size + x);
          const double e = (image[i] - truth[i]) / std::fmax(truth[i], 0.01 * mean);
          sum += e * e;
          ++count;
          result.within += std::abs(e) <= target ? 1.0 / static_cast<double>(truth.size()) : 0;
        }
      }
      result.worst_tile = std::fmax(result.worst_tile, std::sqrt(sum / count));
    }
  }
  return result;
}

int run(const Arguments& a);

}  // namespace

int main(int argc, char** argv) {
  return carlo::run_main([&] {
    Arguments a;
    CLI::App app("measure", "./carlo bench target-error");
    app.add_option("--scene", a.scenes, "scene files")->check(CLI::ExistingFile);
    app.add_option("--folder", a.folder, "folder of scenes")->check(CLI::ExistingDirectory);
    app.add_option("--target", a.target, "relative error");
    app.add_option("--seeds", a.seeds, "adaptive renders");
    app.add_option("--size", a.size, "side of the film");
    app.add_option("--spp", a.spp, "cap");
    app.add_option("--seed", a.seed, "first seed");
    app.add_option("--threads", a.threads, "threads");
    if (const auto code = carlo::parse_arguments(app, argc, argv)) return *code;
    return run(a);
  });
}

namespace {

int run(const Arguments& a) {
  for (const std::string& file : a.scenes) {
    Scene scene = carlo::load_scene(file);
    carlo::resize(scene, a.size, a.size);
    std::vector<Run> adaptive;
    double total = 0;
    for (int s = 0; s < a.seeds; ++s) {
      adaptive.push_back(render(scene, a, a.seed + static_cast<std::uint64_t>(s), a.spp, true));
      total += adaptive.back().seconds;
    }
    Grey sum(adaptive[0].image.size());
    for (const Run& r : adaptive)
      for (std::size_t i = 0; i < sum.size(); ++i)
        sum[i] += r.image[i];
    std::vector<double> within, worst, spp, expected, seconds, decided, capped;
    for (const Run& r : adaptive) {
      Grey truth = sum;
      for (std::size_t i = 0; i < sum.size(); ++i)
        truth[i] = (sum[i] - r.image[i]) / (a.seeds - 1);
      const Errors e = errors(r.image, truth, a.size, a.target);
      within.push_back(e.within);
      worst.push_back(e.worst_tile);
      spp.push_back(r.samples);
      seconds.push_back(r.seconds);
      expected.push_back(r.result.adaptive->within);
      decided.push_back(r.result.adaptive->decided_only);
      capped.push_back(r.result.adaptive->capped);
    }
    fmt::print(
        "{} target {} spp {:.0f} ({}..{}) s {:.2f} within {:.3f} (min {:.3f}) expected {:.3f} "
        "worst tile {:.4f} decided only {:.3f} capped {:.3f}\n",
        fs::path(file).stem().string(), a.target, median(spp), adaptive[0].result.adaptive->least,
        adaptive[0].result.adaptive->most, median(seconds), median(within),
        *std::min_element(within.begin(), within.end()), median(expected), median(worst),
        median(decided), median(capped));
    for (Grey& t : std::vector<Grey>{sum}) {
      for (double& x : t)
        x /= a.seeds;
      for (std::uint32_t n = 256; n <= a.spp; n *= 4) {
        const Run u = render(scene, a, 1000 + a.seed, n, false);
        const Errors e = errors(u.image, t, a.size, a.target);
        fmt::print("   uniform {} s {:.2f} worst {:.4f} within {:.3f}\n", n, u.seconds,
                   e.worst_tile, e.within);
        if (e.worst_tile < median(worst)) break;
      }
    }
  }
  return 0;
}

}  // namespace
