// Traces very many paths through every scene; each must give a finite, nonnegative radiance.

#include "course/cli/arguments.h"
#include "course/cli/main_guard.h"
#include "random/rng.h"
#include "render/driver.h"
#include "render/interrupt.h"
#include "render/scene_film.h"
#include "renderer/path_integrator.h"
#include "scene/load_scene.h"
#include "scene/sampler_kind.h"
#include "support/error.h"
#include "support/progress.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;

struct Arguments {
  std::string folder = "common/scenes";
  std::vector<std::string> scenes;
  double paths = 1e6;
  std::uint64_t seed = 1;
  int threads = 0;
};

struct Row {
  carlo::Counts counts;
  double seconds = 0;
};

/// A film's side with a uniform logarithm: 32 to 512 pixels, fewer if few paths are wanted.
int random_side(double paths, carlo::Rng& rng) {
  const double most = std::min(512.0, std::sqrt(paths)), least = std::min(32.0, most);
  return static_cast<int>(least * std::pow(most / least, rng.uniform()));
}

/// One render of about `paths` paths, at most 2^20: a film with random sides, a random seed and
/// sampler, every other time with light paths, guided, or with pixels that share. Film positions
/// depend on the pixels' samples, so they are new in every render.
void add_render(carlo::Scene& scene, double paths, carlo::Rng& rng, int threads, Row& row) {
  const int width = random_side(paths, rng);
  const int height = random_side(paths, rng);
  const double most = std::min(paths, 0x1p20) / (1.0 * width * height);
  const auto spp = static_cast<std::uint32_t>(std::clamp(std::ceil(most), 1.0, 4096.0));
  const std::uint64_t seed = rng.next_u64();
  scene.sampler = carlo::sampler_kinds.at(rng.next_u32() % carlo::sampler_kinds.size());
  carlo::resize(scene, width, height);
  const bool lights = (rng.next_u32() & 1) != 0 && renderer::light_paths_suit(scene);
  const bool guided = (rng.next_u32() & 1) != 0;
  const bool share = (rng.next_u32() & 1) != 0;
  const auto integrator = renderer::make_path_integrator(
      scene, {.seed = seed,
              .spp = spp,
              .technique = lights ? renderer::Technique::bidirectional : renderer::Technique::path,
              .guidance = guided ? renderer::Guidance::always : renderer::Guidance::none,
              .choices = {.share = share}});
  const carlo::RenderResult result = carlo::render(
      *integrator, width, height, {.spp = spp, .threads = threads, .progress = false});
  row.counts += result.counts;
  row.seconds += result.seconds;
}

Row trace(const fs::path& path, std::uint64_t number, const Arguments& a) {
  carlo::Scene scene = carlo::load_scene(path);
  carlo::Rng rng(a.seed, number);
  carlo::Progress progress(path.stem().string(), true);
  Row row;
  while (static_cast<double>(row.counts.paths) < a.paths && !carlo::interrupt_noted()) {
    add_render(scene, a.paths - static_cast<double>(row.counts.paths), rng, a.threads, row);
    progress.update(static_cast<double>(row.counts.paths) / a.paths);
  }
  return row;
}

void print_row(const std::string& name, const Row& row) {
  const double rate = row.seconds > 0 ? static_cast<double>(row.counts.paths) / row.seconds : 0;
  fmt::print("{:<24} {:>14} {:>14} {:>10.1f} {:>12.0f} {:>8} {:>8}\n", name, row.counts.paths,
             row.counts.light_paths, row.seconds, rate, row.counts.bad, row.counts.cut);
  std::fflush(stdout);
}

std::vector<fs::path> scene_files(const Arguments& a) {
  std::vector<fs::path> files(a.scenes.begin(), a.scenes.end());
  if (!files.empty()) return files;
  for (const auto& entry : fs::directory_iterator(a.folder)) {
    if (entry.path().extension() == ".xml") files.push_back(entry.path());
  }
  if (files.empty()) throw carlo::Error("there is no scene, no .xml file, in {}", a.folder);
  std::sort(files.begin(), files.end());
  return files;
}

int bench(const Arguments& a) {
  const std::vector<fs::path> files = scene_files(a);
  const carlo::InterruptGuard guard;
  fmt::print("{:<24} {:>14} {:>14} {:>10} {:>12} {:>8} {:>8}\n", "scene", "paths", "from lights",
             "seconds", "paths/s", "bad", "cut");
  Row all;
  std::uint64_t number = 0;
  for (const fs::path& file : files) {
    const Row row = trace(file, number++, a);
    print_row(file.stem().string(), row);
    all.counts += row.counts;
    all.seconds += row.seconds;
    if (carlo::interrupt_noted()) break;
  }
  print_row("all", all);
  if (carlo::interrupt_noted()) fmt::print("interrupted: the table holds what was finished\n");
  if (all.counts.bad > 0) {
    throw carlo::Error("{} samples are no radiance: not finite, or negative", all.counts.bad);
  }
  return carlo::interrupt_noted() ? 130 : 0;
}

}  // namespace

int main(int argc, char** argv) {
  return carlo::run_main([&] {
    Arguments a;
    carlo::CommandLine app(
        "Traces paths through every scene, on films of random sizes with ever new seeds and all "
        "samplers, every other film with light paths, and counts those that bring no "
        "radiance. Exit code 1 if there is one.",
        "carlo_many_paths");
    app.option("--paths", a.paths, "paths a scene, such as 1e9").range(1.0, 1e15).show_default();
    app.option("--scene", a.scenes, "scene files (default: all in the folder)").existing_file();
    app.option("--folder", a.folder, "folder of scenes").existing_folder().show_default();
    app.option("--seed", a.seed, "another seed gives other films and paths").show_default();
    app.option("--threads", a.threads, "default: one for each core").range(1, 1024);
    if (const auto code = app.parse(argc, argv)) return *code;
    return bench(a);
  });
}
