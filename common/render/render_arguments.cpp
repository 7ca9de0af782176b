#include "render/render_arguments.h"

#include "course/cli/arguments.h"
#include "render/blocks.h"
#include "render/outputs.h"
#include "render/scene_film.h"
#include "scene/sampler_kind.h"
#include "support/error.h"
#include "support/number.h"

#include <algorithm>
#include <string_view>
#include <utility>

namespace carlo {

namespace fs = std::filesystem;

/// Samples a pixel at most with --target-error.
static constexpr int default_cap = 1 << 16;

void add_options(CommandLine& app, RenderArguments& a) {
  app.option("scene", a.scene, "scene file, Mitsuba 0.6-style XML (default: the Cornell box)");
  app.option("--default-scene", a.default_scene).hidden();  // for the script ./carlo
  app.option("--spp", a.spp, "samples a pixel (default: the scene's)").range(1u, 1u << 28);
  app.option("--seconds", a.seconds, "render for about this long instead").range(0.0, 1e7);
  app.option("--target-error", a.target_error,
             "sample each pixel until its relative error is this, such as .01, at 95 % "
             "confidence; --spp (default: 65536) and --seconds are limits then");
  app.option("--size", a.size, "film size, WIDTHxHEIGHT (default: the scene's)");
  app.option("--max-depth", a.max_depth, "longest path in segments, 0 for no limit")
      .range(0, 1 << 20);
  app.option("--sampler", a.sampler, "independent, stratified or sobol").one_of(sampler_names());
  app.option("--seed", a.seed, "another seed gives independent noise (default: 1)");
  app.option("--threads", a.threads, "default: one for each core").range(1, 1024);
  app.option("-D,--define", a.definitions, "NAME=VALUE for a $NAME of the scene");
  app.option("-o,--output", a.output,
             "base name of .png, .exr, .error.png and .json (default: out/SCENE)");
  app.option("--reference", a.reference, "EXR to measure the error against");
  app.option("--page", a.page, "also a page to look at the image (default: out/SCENE.html)")
      .words(0, 1)
      .type_name("FILE.html");
  app.option("--resume", a.resume,
             "go on with the render in this EXR, with its scene and settings, up to --spp, for "
             "--seconds more, or to its --target-error");
  app.option("--checkpoint", a.checkpoint, "seconds after which a long render's EXR is written")
      .range(0.0, 1e7)
      .show_default();
  app.flag("--no-sums", a.no_sums, "a smaller EXR, which cannot be resumed");
  app.option("--shard", a.shard,
             "the I-th of N shares of the samples alone, into a part, OUTPUT.part, for ./carlo "
             "merge; the same command goes on with a killed one")
      .type_name("I/N");
  app.flag("--slurm", a.slurm,
           "on a cluster: submits an array of shards and their merge to Slurm and waits; the same "
           "command goes on after any failure");
  app.option("--tasks", a.tasks, "of --slurm: shards (default: 16), each of --threads (1)")
      .range(1, static_cast<int>(most_shards));
  app.option("--time", a.time,
             "of --slurm: a task's limit, in sbatch's words; it goes on after it");
  app.option("--partition", a.partition, "of --slurm: where tasks run");
  app.flag("--no-wait", a.no_wait, "of --slurm: return once all is submitted");
  app.option("--slurm-task", a.slurm_task).hidden();
  app.option("--slurm-merge", a.slurm_merge).hidden();
  app.flag("--quiet", a.quiet, "no progress bar, no report on stdout");
}

static int parse_whole(std::string_view text, const std::string& all) {
  if (const auto value = number_of<int>(text)) return *value;
  throw Error("--size is WIDTHxHEIGHT, for example 256x256, got '{}'", all);
}

std::map<std::string, std::string> parse_definitions(const std::vector<std::string>& definitions) {
  std::map<std::string, std::string> map;
  for (const std::string& d : definitions) {
    const auto equals = d.find('=');
    if (equals == 0 || equals == std::string::npos) {
      throw Error("-D takes NAME=VALUE, got '{}'", d);
    }
    if (!map.emplace(d.substr(0, equals), d.substr(equals + 1)).second) {
      throw Error("-D {} was given twice", d.substr(0, equals));
    }
  }
  return map;
}

void apply(const RenderArguments& a, Scene& scene) {
  if (!a.size.empty()) {
    const auto x = std::min(a.size.find('x'), a.size.size());
    const int width = parse_whole(std::string_view(a.size).substr(0, x), a.size);
    const int height =
        parse_whole(std::string_view(a.size).substr(std::min(x + 1, a.size.size())), a.size);
    resize(scene, width, height);
  }
  if (a.target_error) scene.spp = default_cap;
  if (a.spp) scene.spp = static_cast<int>(*a.spp);
  if (a.max_depth) scene.max_depth = *a.max_depth;
  if (!a.sampler.empty()) scene.sampler = sampler_kind(a.sampler);
}

void tell_page_from_scene(RenderArguments& a) {
  if (!a.page || a.page->empty() || fs::path(*a.page).extension() == ".html") return;
  if (!a.scene.empty()) throw Error("--page takes a file that ends in .html, got '{}'", *a.page);
  a.scene = std::exchange(*a.page, "");
}

std::optional<fs::path> page_path(const RenderArguments& a, const fs::path& stem) {
  if (!a.page) return std::nullopt;
  return a.page->empty() ? with_suffix(stem, ".html") : fs::path(*a.page);
}

static void check_slurm(const RenderArguments& a) {
  const auto refuse = [](bool given, const char* option, const char* why) {
    if (given) throw Error("--slurm does not go with {}: {}", option, why);
  };
  if (a.slurm) {
    refuse(a.shard.has_value(), "--shard", "its tasks are the shards");
    refuse(a.seconds.has_value(), "--seconds", "shards are of a number of samples, --spp");
    refuse(!a.resume.empty(), "--resume", "the same command goes on");
    refuse(a.page.has_value(), "--page", "its image has none yet");
    return;
  }
  for (const auto& [given, option] :
       {std::pair{a.tasks.has_value(), "--tasks"}, std::pair{!a.time.empty(), "--time"},
        std::pair{!a.partition.empty(), "--partition"}, std::pair{a.no_wait, "--no-wait"}}) {
    if (given) throw Error("{} is for --slurm", option);
  }
}

void check(const RenderArguments& a) {
  check_slurm(a);
  if (a.shard) {
    const auto refuse = [](bool given, const char* option, const char* why) {
      if (given) throw Error("--shard does not go with {}: {}", option, why);
    };
    refuse(a.seconds.has_value(), "--seconds", "a share is of a number of samples, --spp");
    refuse(a.target_error.has_value(), "--target-error",
           "each pixel's number of samples would hang on those of other shards");
    refuse(!a.resume.empty(), "--resume", "the same command goes on with a killed shard");
    refuse(a.no_sums, "--no-sums", "a part is its sums");
    refuse(!a.reference.empty(), "--reference", "./carlo merge compares, with all the samples");
    refuse(a.page.has_value(), "--page", "a part is no image yet");
  }
  if (a.seconds && a.spp && !a.target_error) {
    throw Error("give --seconds or --spp: both are for --target-error only");
  }
  if (a.target_error && !(*a.target_error > 0 && *a.target_error < 1)) {
    throw Error("--target-error is a fraction between 0 and 1, such as .01, got {}",
                *a.target_error);
  }
}

}  // namespace carlo
