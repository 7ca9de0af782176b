#include "render/render_app.h"

#include "course/cli/arguments.h"
#include "image/exr.h"
#include "render/driver.h"
#include "render/interrupt.h"
#include "render/outputs.h"
#include "render/render_arguments.h"
#include "render/render_page.h"
#include "render/report.h"
#include "render/resume.h"
#include "render/shard_render.h"
#include "render/slurm_job.h"
#include "render/slurm_render.h"
#include "scene/load_scene.h"
#include "support/atomic_file.h"
#include "support/error.h"

#include <fmt/core.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace carlo {
namespace {

namespace fs = std::filesystem;

/// Of --slurm.
constexpr int default_tasks = 16;

/// A render goes on as it began: with its target, or without one.
void take_over_target(RenderArguments& a, const EarlierRender& earlier) {
  const std::optional<double> target = earlier.target_error();
  if (!target) {
    if (a.target_error)
      throw Error("{} has no target error: it goes on by --spp or --seconds", a.resume);
    if (!a.spp && !a.seconds)
      throw Error("--resume goes on up to --spp N or for --seconds S: which?");
    return;
  }
  if (a.target_error.value_or(*target) != *target) {
    throw Error("cannot resume {}: its target error is {}, this render's {}", a.resume, *target,
                *a.target_error);
  }
  a.target_error = target;
  if (!a.spp) a.spp = static_cast<std::uint32_t>(earlier.number("spp_limit"));
}

/// What the command line leaves open is as in the earlier render.
void take_over(RenderArguments& a, const EarlierRender& earlier) {
  take_over_target(a, earlier);
  if (a.scene.empty()) a.scene = earlier.setting("scene");
  if (a.definitions.empty()) a.definitions = earlier.definitions();
  if (a.size.empty()) a.size = fmt::format("{}x{}", earlier.width(), earlier.height());
  if (a.sampler.empty()) a.sampler = earlier.setting("sampler");
  if (!a.max_depth) a.max_depth = static_cast<int>(earlier.number("max_depth"));
  if (!a.seed) a.seed = earlier.number("seed");
  if (a.output.empty()) a.output = fs::path(a.resume).replace_extension().string() + ".exr";
}

/// The result that a render goes on from.
RenderResult result_of(const EarlierRender& earlier, const RenderArguments& a, const Scene& scene) {
  if (a.target_error) {
    auto state = std::make_shared<const AdaptiveState>(earlier.adaptive_state());
    RenderResult result{.film = state->film(), .counts = earlier.counts()};
    result.seconds = earlier.seconds(result.film);
    result.adaptive_state = std::move(state);
    return result;
  }
  RenderResult result{
      .film = earlier.film(), .counts = earlier.counts(), .lamp_ties = earlier.lamp_ties()};
  result.seconds = earlier.seconds(result.film);
  const std::uint32_t block = result.film.block();
  const auto pixels =
      static_cast<std::uint64_t>(scene.width) * static_cast<std::uint64_t>(scene.height);
  if (a.spp && (*a.spp % block != 0 || *a.spp * pixels <= result.film.samples())) {
    throw Error("--spp {} is no way to go on from {:.6g}: expected more, a multiple of {}", *a.spp,
                static_cast<double>(result.film.samples()) / static_cast<double>(pixels), block);
  }
  return result;
}

/// What was decided when a render on a cluster was begun.
std::optional<bool> lamps_of(const RenderArguments& a) {
  std::optional<SlurmPlan> plan;
  for (const std::string& folder : {a.slurm_task, a.slurm_merge}) {
    if (!folder.empty()) plan = SlurmFolder(folder).plan();
  }
  if (a.slurm) plan = SlurmFolder::beside(output_stem(a.output, a.scene)).plan();
  return plan ? std::optional(plan->lamps) : std::nullopt;
}

int submit(const RenderArguments& a, const Scene& scene, const Integrator& integrator,
           RenderSettings settings, std::vector<std::string> words) {
  settings.erase("kernel");
  SlurmRender render{.plan = {.settings = std::move(settings),
                              .scene = a.scene,
                              .width = scene.width,
                              .height = scene.height,
                              .spp = scene.spp,
                              .target_error = a.target_error.value_or(0),
                              .lamps = integrator.lamp_paths() > 0,
                              .shards = a.tasks.value_or(default_tasks),
                              .words = std::move(words),
                              .start = fs::current_path().string(),
                              .threads = std::max(a.threads, 1),
                              .time = a.time,
                              .partition = a.partition},
                     .tasks_given = a.tasks.has_value(),
                     .wait = !a.no_wait,
                     .quiet = a.quiet};
  SlurmFolder folder = SlurmFolder::beside(output_stem(a.output, a.scene));
  return render_on_slurm(folder, std::move(render));
}

int run(RenderArguments a, const IntegratorFactory& factory, const std::string& command,
        const std::vector<std::string>& words) {
  check(a);
  const MergeOutput merged{.output = a.output, .reference = a.reference, .sums = !a.no_sums};
  if (!a.slurm_merge.empty() && !a.target_error) {
    SlurmFolder folder(a.slurm_merge);
    return run_slurm_merge(folder, merged);
  }
  // A job that is told to end has its checkpoint to write, whatever it is at.
  std::optional<InterruptGuard> guard;
  if (!a.slurm_task.empty()) guard.emplace();
  std::optional<Shard> shard;
  if (a.shard) shard = shard_of(*a.shard);
  std::optional<EarlierRender> earlier;
  if (!a.resume.empty()) {
    earlier.emplace(a.resume);
    take_over(a, *earlier);
  }
  Scene scene = load_scene(a.scene, parse_definitions(a.definitions));
  apply(a, scene);
  std::optional<ExrFile> reference;
  if (!a.reference.empty()) {
    reference = read_exr(a.reference);
    compare(reference->image, Image(scene.width, scene.height));
  }

  const std::uint64_t seed = a.seed.value_or(1);
  const auto spp = static_cast<std::uint32_t>(scene.spp);
  const std::uint32_t planned = earlier ? static_cast<std::uint32_t>(earlier->number("planned_spp"))
                                : a.target_error ? adaptive_strata
                                                 : spp;
  const auto integrator = factory(scene, seed, planned, lamps_of(a));
  RenderSettings settings =
      render_settings(scene, integrator->name(), seed, planned, a.definitions);
  if (a.target_error) {
    settings["target_error"] = fmt::format("{}", *a.target_error);
    settings["spp_limit"] = std::to_string(spp);
  }
  if (shard || !a.slurm_task.empty() || !a.slurm_merge.empty()) {
    const ShardRender share{.shard = shard.value_or(Shard{}),
                            .scene = a.scene,
                            .output = a.output,
                            .settings = settings,
                            .spp = spp,
                            .threads = a.threads,
                            .checkpoint_seconds = a.checkpoint,
                            .quiet = a.quiet};
    if (!a.slurm_merge.empty()) {
      SlurmFolder folder(a.slurm_merge);
      return run_slurm_round_merge(folder, scene, *integrator, share, merged);
    }
    return shard ? render_shard(scene, *integrator, share)
                 : run_slurm_task(SlurmFolder(a.slurm_task), scene, *integrator, share);
  }
  if (a.slurm) return submit(a, scene, *integrator, settings, words);
  std::optional<RenderResult> start;
  if (earlier) {
    earlier->require_same(settings);
    start = result_of(*earlier, a, scene);
  }
  const Outputs outputs(output_stem(a.output, a.scene), settings, !a.no_sums);
  const std::optional<fs::path> page = page_path(a, outputs.stem());
  if (page) const AtomicFile writable(*page);
  const auto report_on = [&](const RenderResult& result) {
    RenderReport report = make_report(scene, result);
    report.scene = a.scene;
    report.kernel = integrator->name();
    report.seed = seed;
    if (!result.adaptive) report.expect_asks(integrator->least_light_chance());
    if (reference) report.reference = compare_with_reference(result, a.reference, *reference);
    return report;
  };
  const RenderOptions options{
      .spp = spp,
      .seconds = a.seconds,
      .threads = a.threads,
      .progress = !a.quiet,
      .target_error = a.target_error,
      .earlier = start ? &*start : nullptr,
      .checkpoint = [&](const RenderResult& r) { outputs.checkpoint(r, report_on(r)); },
      .checkpoint_seconds = a.checkpoint};
  const RenderResult result = render(*integrator, scene.width, scene.height, options);
  const RenderReport report = report_on(result);
  outputs.write(result, report);
  if (page) write_render_page(*page, command, report, result.film, reference);
  if (!a.quiet) {
    fmt::print("{}", to_text(report));
    for (const std::string& note : scene.notes)
      fmt::print("  {:<16} {}\n", "note", note);
    if (start && start->seconds == 0) {
      fmt::print("  {:<16} the time is that of this part: no report lies beside {}\n", "note",
                 a.resume);
    }
    fmt::print("  {:<16} {}\n", "written", outputs.names(result));
    if (page) fmt::print("  {:<16} {}\n", "page", page->string());
  }
  return result.interrupted ? 130 : 0;
}

}  // namespace

int render_app(int argc, char** argv, const IntegratorFactory& factory,
               const std::function<void(CommandLine&)>& add_options) {
  RenderArguments arguments;
  CommandLine app("Renders a scene by path tracing: PNG, EXR and a report of error against time.",
                  "./carlo render");
  carlo::add_options(app, arguments);
  if (add_options) add_options(app);
  if (const auto code = app.parse(argc, argv)) return *code;
  tell_page_from_scene(arguments);
  if (arguments.scene.empty() && arguments.resume.empty()) {
    arguments.scene = arguments.default_scene;
    if (arguments.scene.empty()) throw Error("which scene? (see ./carlo render --help)");
  }
  return run(arguments, factory, command_text(argc, argv),
             std::vector<std::string>(argv + 1, argv + argc));
}

}  // namespace carlo
