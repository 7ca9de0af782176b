// `./carlo bench render`: error against time of the reference renderer, on one thread.

#include "cli/arguments.h"
#include "cli/main_guard.h"
#include "image/exr.h"
#include "image/metrics.h"
#include "render/driver.h"
#include "render/render_app.h"
#include "renderer/flat/flat_kernel.h"
#include "renderer/path_integrator.h"
#include "scene/load_scene.h"

#include <CLI/CLI.hpp>
#include <fmt/core.h>

#include <algorithm>
#include <ctime>
#include <filesystem>
#include <string>
#include <vector>

namespace {

/// An independent renderer's relMSE x seconds on the same scenes at 256x256 and 64 samples a pixel,
/// one thread: Tungsten, see tests/references/README.md.
struct Peer {
  const char* scene;
  double seconds, rel_mse;
};
constexpr Peer peers[] = {{"peer_cornell_lambert", 5.60, .00304},
                          {"peer_cornell_phong", 5.66, .00652}};

struct Arguments {
  std::string references = "tests/references";
  int runs = 5;
  std::uint32_t spp = 64;
  int threads = 1;
  std::string kernel = "best";
};

double median(std::vector<double> x) {
  std::sort(x.begin(), x.end());
  return x[x.size() / 2];
}

void bench(const Peer& peer, const Arguments& a) {
  const std::filesystem::path folder(a.references);
  carlo::Scene scene = carlo::load_scene(folder / (std::string(peer.scene) + ".xml"));
  const carlo::Image reference = carlo::read_exr(folder / (std::string(peer.scene) + ".exr")).image;
  scene.spp = static_cast<int>(a.spp);
  scene.sampler = carlo::SamplerKind::sobol;
  std::vector<double> seconds, rel_mse, product;
  double paths = 0;
  for (int run = 0; run < a.runs; ++run) {
    const auto seed = static_cast<std::uint64_t>(run + 1);
    const auto integrator = renderer::make_path_integrator(
        scene,
        {.seed = seed,
         .spp = a.spp,
         .kernel = a.kernel == "scalar" ? renderer::Kernel::scalar : renderer::Kernel::best});
    const std::clock_t start = std::clock();
    const carlo::RenderResult result =
        carlo::render(*integrator, scene.width, scene.height, carlo::radiance_scale(scene),
                      {.spp = a.spp, .seconds = {}, .threads = a.threads, .progress = false});
    seconds.push_back(a.threads == 1 ? static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC
                                     : result.seconds);
    rel_mse.push_back(carlo::compare(result.film.mean(), reference).rel_mse);
    product.push_back(seconds.back() * rel_mse.back());
    paths = static_cast<double>(result.counts.paths);
  }
  const auto [low, high] = std::minmax_element(product.begin(), product.end());
  const double target = peer.seconds * peer.rel_mse;
  fmt::print("{:<22} {:>8.3f} {:>9.3f} {:>10.5f} {:>12.5f} {:>9.5f}-{:.5f} {:>10.4f} {:>8.2f}\n",
             peer.scene, median(seconds), 1e6 * median(seconds) / paths, median(rel_mse),
             median(product), *low, *high, target, target / median(product));
}

int run(int argc, char** argv) {
  Arguments a;
  CLI::App app("Measures relMSE x seconds of the reference renderer on the peer scenes.",
               "./carlo bench render");
  app.add_option("--references", a.references, "folder of the scenes and reference images")
      ->capture_default_str();
  app.add_option("--runs", a.runs, "runs with different seeds; medians are printed")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  app.add_option("--spp", a.spp, "samples a pixel")
      ->check(CLI::Range(8u, 1u << 20))
      ->capture_default_str();
  app.add_option("--threads", a.threads, "threads")
      ->check(CLI::Range(1, 1024))
      ->capture_default_str();
  app.add_option("--kernel", a.kernel, "best, scalar, or an instruction set: AVX3, AVX2, SSE4")
      ->capture_default_str();
  if (const auto code = carlo::parse_arguments(app, argc, argv)) return *code;
  if (a.kernel != "best" && a.kernel != "scalar") renderer::use_instruction_set(a.kernel);
  fmt::print("256 x 256, {} samples a pixel, {} thread(s), medians of {} runs\n", a.spp, a.threads,
             a.runs);
  fmt::print("{:<22} {:>8} {:>9} {:>10} {:>12} {:>17} {:>10} {:>8}\n", "scene", "seconds",
             "us/path", "relMSE", "relMSE x s", "(min-max)", "peer's", "better x");
  for (const Peer& peer : peers)
    bench(peer, a);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  return carlo::run_main([&] { return run(argc, argv); });
}
