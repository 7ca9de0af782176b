// `./carlo bench render`: error against time for the reference renderer, on one thread.

#include "course/cli/arguments.h"
#include "course/cli/main_guard.h"
#include "course/report/stopwatch.h"
#include "image/exr.h"
#include "image/metrics.h"
#include "render/driver.h"
#include "render/scene_film.h"
#include "renderer/bench/spread.h"
#include "renderer/lanes/lane_kernel.h"
#include "renderer/path_integrator.h"
#include "scene/load_scene.h"

#include <fmt/core.h>

#include <filesystem>
#include <string>
#include <vector>

namespace {

using bench::median, bench::spread;

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
  std::vector<std::string> kernels = {"best"};
  bool ablation = false;
};

/// A way to render that is compared with others.
struct Variant {
  std::string name;
  std::string kernel = "best";  ///< or "scalar", or an instruction set
  carlo::SamplerKind sampler = carlo::SamplerKind::sobol;
  renderer::LaneChoices choices{};
  renderer::Technique technique = renderer::Technique::automatic;  ///< as in `./carlo render`
  renderer::Guidance guidance = renderer::Guidance::automatic;
  bool share = true;
  std::vector<double> seconds{}, rel_mse{}, product{};
};

std::vector<Variant> variants(const Arguments& a) {
  std::vector<Variant> result;
  for (const std::string& kernel : a.kernels)
    result.push_back({.name = kernel, .kernel = kernel});
  if (!a.ablation) return result;
  const std::string kernel = a.kernels.front();
  for (const float threshold : {1.0f, 0.5f, 0.125f}) {
    result.push_back({.name = fmt::format("roulette from {}", threshold),
                      .kernel = kernel,
                      .choices = {.roulette_threshold = threshold}});
  }
  result.push_back(
      {.name = "balance heuristic", .kernel = kernel, .choices = {.power_heuristic = false}});
  result.push_back(
      {.name = "independent points", .kernel = kernel, .sampler = carlo::SamplerKind::independent});
  if (kernel == "scalar") return result;
  result.push_back({.name = "not guided", .kernel = kernel, .guidance = renderer::Guidance::none});
  result.push_back({.name = "not shared", .kernel = kernel, .share = false});
  result.push_back(
      {.name = "no rays to lights", .kernel = kernel, .choices = {.lights_apart = false}});
  result.push_back(
      {.name = "no light paths", .kernel = kernel, .technique = renderer::Technique::path});
  result.push_back(
      {.name = "light paths", .kernel = kernel, .technique = renderer::Technique::bidirectional});
  return result;
}

/// Renders once. On one thread, seconds are processor time, which other load affects less.
void render_once(carlo::Scene scene, const carlo::Image& reference, const Arguments& a,
                 std::uint64_t seed, Variant& variant) {
  scene.sampler = variant.sampler;
  const bool scalar = variant.kernel == "scalar";
  renderer::use_instruction_set(scalar || variant.kernel == "best" ? "" : variant.kernel);
  const carlo::Stopwatch stopwatch;
  const auto integrator = renderer::make_path_integrator(
      scene, {.seed = seed,
              .spp = a.spp,
              .kernel = scalar ? renderer::Kernel::scalar : renderer::Kernel::best,
              .technique = variant.technique,
              .guidance = variant.guidance,
              .share = variant.share,
              .choices = variant.choices});
  const carlo::RenderResult result =
      carlo::render(*integrator, scene.width, scene.height,
                    {.spp = a.spp, .threads = a.threads, .progress = false});
  const double busy = stopwatch.seconds();
  variant.seconds.push_back(a.threads == 1 ? busy : result.seconds);
  variant.rel_mse.push_back(carlo::compare(result.film.mean(), reference).rel_mse);
  variant.product.push_back(variant.seconds.back() * variant.rel_mse.back());
}

void print(const Peer& peer, const Variant& variant, double paths) {
  const bench::Spread product = spread(variant.product);
  const double target = peer.seconds * peer.rel_mse;
  fmt::print(
      "{:<21} {:<19} {:>8.3f} {:>8.3f} {:>9.5f} {:>11.5f} {:>9.5f}-{:.5f} {:>8.4f} {:>8.2f}\n",
      peer.scene, variant.name, median(variant.seconds), 1e6 * median(variant.seconds) / paths,
      median(variant.rel_mse), product.median, product.least, product.greatest, target,
      target / product.median);
}

/// All variants alternate, so that other load affects them alike.
void measure(const Peer& peer, const Arguments& a) {
  const std::filesystem::path folder(a.references);
  carlo::Scene scene = carlo::load_scene(folder / (std::string(peer.scene) + ".xml"));
  const carlo::Image reference = carlo::read_exr(folder / (std::string(peer.scene) + ".exr")).image;
  scene.spp = static_cast<int>(a.spp);
  std::vector<Variant> all = variants(a);
  for (int i = 0; i < a.runs; ++i) {
    for (Variant& variant : all)
      render_once(scene, reference, a, static_cast<std::uint64_t>(i + 1), variant);
  }
  for (const Variant& variant : all)
    print(peer, variant, static_cast<double>(a.spp) * scene.width * scene.height);
}

int run(int argc, char** argv) {
  Arguments a;
  carlo::CommandLine app("Measures relMSE x seconds of the reference renderer on the peer scenes.",
                         "./carlo bench render");
  app.option("--references", a.references, "folder of the scenes and reference images")
      .show_default();
  app.option("--runs", a.runs, "runs with different seeds; medians are printed")
      .range(1, 1000)
      .show_default();
  app.option("--spp", a.spp, "samples a pixel").range(8u, 1u << 20).show_default();
  app.option("--threads", a.threads, "threads").range(1, 1024).show_default();
  app.option("--kernel", a.kernels,
             "best, scalar, or instruction sets: AVX3 (AVX-512), AVX2; several: AVX3,AVX2")
      .list(',')
      .show_default();
  app.flag("--ablation", a.ablation, "also with other choices, each by itself");
  if (const auto code = app.parse(argc, argv)) return *code;
  fmt::print("256 x 256, {} samples a pixel, {} thread(s), medians of {} runs; seconds are {}\n",
             a.spp, a.threads, a.runs, a.threads == 1 ? "the processor's" : "of the clock");
  fmt::print("{:<21} {:<19} {:>8} {:>8} {:>9} {:>11} {:>17} {:>8} {:>8}\n", "scene", "kernel",
             "seconds", "us/path", "relMSE", "relMSE x s", "(min-max)", "peer's", "better x");
  for (const Peer& peer : peers)
    measure(peer, a);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  return carlo::run_main([&] { return run(argc, argv); });
}
