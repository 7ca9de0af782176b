#include "renderer/production/render_command.h"

#include "course/cli/arguments.h"
#include "course/render/outputs.h"
#include "course/render/render_page.h"
#include "render/driver.h"
#include "render/interrupt.h"
#include "renderer/production/adaptive_state.h"
#include "renderer/production/arguments.h"
#include "renderer/production/image_render.h"
#include "renderer/production/resume.h"
#include "renderer/production/shard_render.h"
#include "renderer/production/slurm_job.h"
#include "renderer/production/slurm_render.h"
#include "scene/load_scene.h"
#include "support/error.h"

#include <fmt/core.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace carlo {
namespace {

namespace fs = std::filesystem;

/// Throws unless both or neither have a target error.
void fill_from_target(ProductionArguments& a, const EarlierRender& earlier) {
  const std::optional<double> target = earlier.target_error();
  if (!target) {
    if (a.target_error)
      throw Error("{} has no target error: continue it with --spp or --seconds", a.resume);
    if (!a.spp && !a.seconds)
      throw Error("--resume continues up to --spp N or for --seconds S: which?");
    return;
  }
  if (a.target_error.value_or(*target) != *target) {
    throw Error("cannot resume {}: its target error is {}, this render's {}", a.resume, *target,
                *a.target_error);
  }
  a.target_error = target;
  if (!a.spp) a.spp = static_cast<std::uint32_t>(earlier.number("spp_limit"));
}

/// Takes options that the command line leaves open from the earlier render. Throws Error for
/// options with which it cannot be continued.
void fill_from(ProductionArguments& a, const EarlierRender& earlier) {
  fill_from_target(a, earlier);
  if (a.scene.empty()) a.scene = earlier.setting("scene");
  if (a.definitions.empty()) a.definitions = earlier.definitions();
  if (a.size.empty()) a.size = fmt::format("{}x{}", earlier.width(), earlier.height());
  if (a.sampler.empty()) a.sampler = earlier.setting("sampler");
  if (!a.max_depth) a.max_depth = static_cast<int>(earlier.number("max_depth"));
  if (!a.seed) a.seed = earlier.number("seed");
  if (a.output.empty()) a.output = fs::path(a.resume).replace_extension().string() + ".exr";
}

/// Returns the state to continue from, up to `spp` samples per pixel if given. Throws Error if the
/// render cannot be continued to that number.
RenderResult uniform_start(const EarlierRender& earlier, std::optional<std::uint32_t> spp) {
  RenderResult result{
      .film = earlier.film(), .counts = earlier.counts(), .covariance = earlier.covariance()};
  result.seconds = earlier.seconds(result.film);
  const std::uint32_t block = result.film.block();
  const auto pixels =
      static_cast<std::uint64_t>(earlier.width()) * static_cast<std::uint64_t>(earlier.height());
  if (spp && (*spp % block != 0 || *spp * pixels <= result.film.samples())) {
    throw Error(
        "cannot continue from {1:.6g} samples to --spp {0}: expected more, a multiple of {2}", *spp,
        static_cast<double>(result.film.samples()) / static_cast<double>(pixels), block);
  }
  return result;
}

/// The same for a render with a target error.
EarlierAdaptive adaptive_start(const EarlierRender& earlier) {
  EarlierAdaptive start{earlier.adaptive_state(), earlier.counts()};
  start.seconds = earlier.seconds(start.state.film());
  return start;
}

/// The default for --slurm.
constexpr int default_tasks = 16;

struct Command {
  ProductionArguments a;
  const ProductionFactory& factory;
  std::string text;                ///< as the reader can type it again
  std::vector<std::string> words;  ///< as the program received it
};

/// `planned` and `light_paths` are set if they were decided before.
RenderTask task_of(const Command& command, std::optional<std::uint32_t> planned = {},
                   std::optional<bool> light_paths = {}) {
  const ProductionArguments& a = command.a;
  RenderTask task{.scene = load_scene(a.scene, parse_definitions(a.definitions))};
  apply(a, task.scene);
  task.seed = a.seed.value_or(1);
  task.spp = static_cast<std::uint32_t>(task.scene.spp);
  task.reference = read_reference(a.reference, task.scene.width, task.scene.height);
  if (!planned) planned = a.target_error ? adaptive_strata : task.spp;
  task.integrator = command.factory(task.scene, {.seed = task.seed,
                                                 .spp = *planned,
                                                 .to_target = a.target_error.has_value(),
                                                 .light_paths = light_paths});
  task.settings =
      render_settings(task.scene, task.integrator->name(), task.seed, *planned, a.definitions);
  if (a.target_error) {
    task.settings["target_error"] = fmt::format("{}", *a.target_error);
    task.settings["spp_limit"] = std::to_string(task.spp);
  }
  return task;
}

int run_plain(const Command& command) {
  const RenderTask task = task_of(command);
  const ImageRender image(command.a, task, command.text);
  const RenderResult* const nothing = nullptr;
  return image.run(nothing);
}

int run_to_target(const Command& command) {
  const RenderTask task = task_of(command);
  const ImageRender image(command.a, task, command.text);
  const EarlierAdaptive* const nothing = nullptr;
  return image.run(nothing);
}

int run_resumed(Command command) {
  const EarlierRender earlier(command.a.resume);
  fill_from(command.a, earlier);
  const RenderTask task =
      task_of(command, static_cast<std::uint32_t>(earlier.number("planned_spp")));
  earlier.require_same(task.settings);
  if (command.a.target_error) {
    const EarlierAdaptive start = adaptive_start(earlier);
    return ImageRender(command.a, task, command.text).run(&start);
  }
  const RenderResult start = uniform_start(earlier, command.a.spp);
  return ImageRender(command.a, task, command.text).run(&start);
}

ShardRender share_of(const Command& command, const RenderTask& task, const Shard& shard) {
  return {.shard = shard,
          .scene = command.a.scene,
          .output = command.a.output,
          .settings = task.settings,
          .spp = task.spp,
          .threads = command.a.threads,
          .checkpoint_seconds = command.a.checkpoint,
          .quiet = command.a.quiet};
}

int run_shard(const Command& command) {
  const Shard shard = shard_of(*command.a.shard);
  const RenderTask task = task_of(command);
  return render_shard(task.scene, *task.integrator, share_of(command, task, shard));
}

/// Returns the folder of a render on a cluster, beside its image.
SlurmFolder folder_of(const ProductionArguments& a) {
  return SlurmFolder::beside(output_stem(a.output, a.scene));
}

/// True if light paths are traced, as decided when the render was begun; nothing if none was.
std::optional<bool> light_paths_of(const SlurmFolder& folder) {
  const auto plan = folder.plan();
  return plan ? std::optional(plan->light_paths) : std::nullopt;
}

int run_submission(const Command& command) {
  const ProductionArguments& a = command.a;
  SlurmFolder folder = folder_of(a);
  RenderTask task = task_of(command, {}, light_paths_of(folder));
  task.settings.erase("kernel");
  SlurmRender render{.plan = {.settings = std::move(task.settings),
                              .scene = a.scene,
                              .width = task.scene.width,
                              .height = task.scene.height,
                              .spp = task.scene.spp,
                              .target_error = a.target_error.value_or(0),
                              .light_paths = task.integrator->light_paths() > 0,
                              .shards = a.tasks.value_or(default_tasks),
                              .words = command.words,
                              .start = fs::current_path().string(),
                              .threads = std::max(a.threads, 1),
                              .time = a.time,
                              .partition = a.partition},
                     .tasks_given = a.tasks.has_value(),
                     .wait = !a.no_wait,
                     .quiet = a.quiet};
  return render_on_slurm(folder, std::move(render));
}

int run_task_of_cluster(const Command& command) {
  // A job that is told to end must write its checkpoint, whatever it is doing.
  const InterruptGuard guard;
  const SlurmFolder folder(command.a.slurm_task);
  const RenderTask task = task_of(command, {}, light_paths_of(folder));
  return run_slurm_task(folder, task.scene, *task.integrator, share_of(command, task, {}));
}

int run_merge_of_cluster(const Command& command) {
  const ProductionArguments& a = command.a;
  SlurmFolder folder(a.slurm_merge);
  const MergeOutput output{.output = a.output, .reference = a.reference, .sums = !a.no_sums};
  if (!a.target_error) return run_slurm_merge(folder, output);
  const RenderTask task = task_of(command, {}, light_paths_of(folder));
  return run_slurm_round_merge(folder, task.scene, *task.integrator, share_of(command, task, {}),
                               output);
}

int run(const Command& command) {
  const ProductionArguments& a = command.a;
  check(a);
  if (!a.slurm_merge.empty()) return run_merge_of_cluster(command);
  if (!a.slurm_task.empty()) return run_task_of_cluster(command);
  if (a.slurm) return run_submission(command);
  if (a.shard) return run_shard(command);
  if (!a.resume.empty()) return run_resumed(command);
  return a.target_error ? run_to_target(command) : run_plain(command);
}

}  // namespace

int render_command(int argc, char** argv, const ProductionFactory& factory,
                   const std::function<void(CommandLine&)>& add_options) {
  Command command{.a = {},
                  .factory = factory,
                  .text = command_text(argc, argv),
                  .words = {argv + 1, argv + argc}};
  CommandLine app("Renders a scene by path tracing: PNG, EXR and a report of error against time.",
                  "./carlo render");
  add_production_options(app, command.a);
  add_options(app);
  if (const auto code = app.parse(argc, argv)) return *code;
  tell_page_from_scene(command.a);
  if (command.a.resume.empty()) settle_scene(command.a);
  return run(command);
}

}  // namespace carlo
