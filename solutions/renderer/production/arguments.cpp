#include "renderer/production/arguments.h"

#include "course/cli/arguments.h"
#include "renderer/production/block_set.h"
#include "support/error.h"

#include <utility>

namespace carlo {

/// The limit of samples per pixel with --target-error.
static constexpr int default_cap = 1 << 16;

void add_production_options(CommandLine& app, ProductionArguments& a) {
  add_render_options(app, a);
  app.option("--target-error", a.target_error,
             "sample each pixel until its relative error is this, such as .01, at 95 % "
             "confidence; --spp (default: 65536) and --seconds are limits then");
  app.option(
      "--resume", a.resume,
      "continue the render in this EXR with its scene and settings, up to --spp, for --seconds "
      "more, or to its --target-error");
  app.option("--checkpoint", a.checkpoint, "seconds between checkpoints of the EXR")
      .range(0.0, 1e7)
      .show_default();
  app.flag("--no-sums", a.no_sums, "a smaller EXR, which cannot be resumed");
  app.option("--shard", a.shard,
             "render only shard I of N, into OUTPUT.part, for ./carlo merge; rerun to resume")
      .type_name("I/N");
  app.flag("--slurm", a.slurm,
           "submit an array of shards and their merge to Slurm and wait; rerun to recover from any "
           "failure");
  app.option("--tasks", a.tasks,
             "with --slurm: number of shards (default: 16), each with --threads (1)")
      .range(1, static_cast<int>(most_shards));
  app.option("--time", a.time,
             "with --slurm: time limit of a task, in sbatch's format; tasks continue after it");
  app.option("--partition", a.partition, "with --slurm: the partition for the tasks");
  app.flag("--no-wait", a.no_wait, "with --slurm: return after submitting");
  app.option("--slurm-task", a.slurm_task).hidden();
  app.option("--slurm-merge", a.slurm_merge).hidden();
}

void apply(const ProductionArguments& a, Scene& scene) {
  apply(static_cast<const RenderArguments&>(a), scene);
  if (a.target_error && !a.spp) scene.spp = default_cap;
}

static void check_slurm(const ProductionArguments& a) {
  const auto refuse = [](bool given, const char* option, const char* why) {
    if (given) throw Error("--slurm does not go with {}: {}", option, why);
  };
  if (a.slurm) {
    refuse(a.shard.has_value(), "--shard", "its tasks are the shards");
    refuse(a.seconds.has_value(), "--seconds", "shards are of a number of samples, --spp");
    refuse(!a.resume.empty(), "--resume", "the same command continues");
    refuse(a.page.has_value(), "--page", "its image has none yet");
    return;
  }
  for (const auto& [given, option] :
       {std::pair{a.tasks.has_value(), "--tasks"}, std::pair{!a.time.empty(), "--time"},
        std::pair{!a.partition.empty(), "--partition"}, std::pair{a.no_wait, "--no-wait"}}) {
    if (given) throw Error("{} is for --slurm", option);
  }
}

void check(const ProductionArguments& a) {
  check_slurm(a);
  if (a.shard) {
    const auto refuse = [](bool given, const char* option, const char* why) {
      if (given) throw Error("--shard does not go with {}: {}", option, why);
    };
    refuse(a.seconds.has_value(), "--seconds", "shards divide a fixed --spp");
    refuse(a.target_error.has_value(), "--target-error",
           "each pixel's number of samples would depend on other shards");
    refuse(!a.resume.empty(), "--resume", "rerun the same command to resume a shard");
    refuse(a.no_sums, "--no-sums", "a part consists of its sums");
    refuse(!a.reference.empty(), "--reference", "./carlo merge compares, with all the samples");
    refuse(a.page.has_value(), "--page", "a part is not an image");
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
