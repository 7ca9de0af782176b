#include "renderer/production/slurm_job.h"

#include "course/cli/program.h"
#include "course/render/outputs.h"
#include "course/render/report.h"
#include "image/exr.h"
#include "render/interrupt.h"
#include "renderer/production/adaptive.h"
#include "renderer/production/merge.h"
#include "renderer/production/part.h"
#include "renderer/production/reports.h"
#include "renderer/production/resumable_outputs.h"
#include "renderer/production/resume.h"
#include "renderer/production/shard_render.h"
#include "renderer/production/slurm_folder.h"
#include "renderer/production/slurm_render.h"
#include "support/error.h"
#include "support/number.h"

#include <fmt/core.h>

#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <system_error>
#include <vector>

namespace carlo {
namespace {

namespace fs = std::filesystem;

EarlierAdaptive read_round(const fs::path& path, const RenderSettings& settings) {
  const EarlierRender file(path);
  file.require_same(settings);
  return {file.adaptive_state(), file.counts(), file.real("seconds")};
}

/// The common state before the current round.
EarlierAdaptive before(const SlurmFolder& folder, const SlurmPlan& plan,
                       const RenderSettings& settings) {
  const int round = folder.round();
  if (round == 0) return {AdaptiveState(plan.width, plan.height)};
  return read_round(folder.round_state(round), settings);
}

AdaptiveGoal goal_of(const SlurmPlan& plan, const ShardRender& render) {
  return {plan.target_error, render.spp, {}};
}

/// Returns a variable of the environment of Slurm's jobs. Throws Error if it is not set.
std::string variable(const char* name) {
  const char* const value = std::getenv(name);
  if (value == nullptr) throw Error("{} is not set: only Slurm's jobs run this", name);
  return value;
}

/// Returns the exit code of an interrupted task: 0 if its time was up (SIGUSR1), after queueing it
/// again, else `code`. Throws Error if its time was up without progress.
int end_early(int code, bool further) {
  if (interrupt_signal() != SIGUSR1) return code;
  if (!further) throw Error("time was up before anything was finished: --time is too short");
  fmt::print("time is up; queued again\n");
  std::fflush(stdout);  // Slurm ends a job that it queues again
  output_of({"scontrol", "requeue", variable("SLURM_JOB_ID")});
  return 0;
}

/// Writes a state, or a share's part of it, with the counts and the time of `result`.
void write_round(const fs::path& path, const RenderSettings& settings, const AdaptiveState& state,
                 const RenderResult& result) {
  ExrFile file{.image = state.film().mean()};
  RenderSettings attributes = settings;
  attributes["seconds"] = fmt::format("{}", result.seconds);
  add_sums(file, attributes, state, result.counts);
  write_exr(path, file);
}

/// Renders a share of the current round, or the rest of it. Returns the exit code; throws Error.
int render_round_share(const SlurmFolder& folder, const SlurmPlan& plan,
                       const Integrator& integrator, const ShardRender& render, int shard) {
  const int number = folder.round();
  const fs::path whole = folder.round_part(number, shard);
  const fs::path begun = folder.round_part_begun(number, shard);
  if (fs::exists(whole)) return 0;
  const EarlierAdaptive base = before(folder, plan, render.settings);
  EarlierAdaptive mine{base.state};
  if (fs::exists(begun)) {
    const EarlierAdaptive part = read_round(begun, render.settings);
    add_round_part(mine.state, part.state);
    mine.counts = part.counts;
    mine.seconds = part.seconds;
  }
  const auto write = [&](const fs::path& path, const AdaptiveResult& r) {
    write_round(path, render.settings, round_part(*r.state, base.state), r);
  };
  const AdaptiveOptions options{
      .threads = plan.threads,
      .progress = false,
      .earlier = &mine,
      .checkpoint = [&](const AdaptiveResult& r) { write(begun, r); },
      .checkpoint_seconds = render.checkpoint_seconds,
      .share = Shard{static_cast<std::uint32_t>(shard), static_cast<std::uint32_t>(plan.shards)}};
  const AdaptiveResult result =
      render_adaptively(integrator, plan.width, plan.height, goal_of(plan, render), options);
  write(result.interrupted ? begun : whole, result);
  if (result.interrupted) return end_early(130, result.counts.paths > mine.counts.paths);
  std::error_code ignored;  // if it remains, it is removed with its round
  fs::remove(begun, ignored);
  return 0;
}

/// Merges all shares of the current round and makes its decisions. Throws Error if one cannot be
/// read.
AdaptiveResult merge_round(const SlurmFolder& folder, const SlurmPlan& plan,
                           const Integrator& integrator, const ShardRender& render) {
  EarlierAdaptive all = before(folder, plan, render.settings);
  for (int i = 1; i <= plan.shards; ++i) {
    const fs::path path = folder.round_part(folder.round(), i);
    const EarlierAdaptive part = read_round(path, render.settings);
    try {
      add_round_part(all.state, part.state);
    } catch (const Error& error) {
      throw Error("cannot merge {}: {}", path.string(), error.what());
    }
    all.counts += part.counts;
    all.seconds += part.seconds;
  }
  return render_adaptively(
      integrator, plan.width, plan.height, goal_of(plan, render),
      {.threads = plan.threads, .progress = false, .earlier = &all, .one_round = true});
}

/// The id of this job's array.
std::string own_array() {
  return variable("SLURM_ARRAY_JOB_ID");
}

/// True if shards are missing; then submits them again, or sets `code` to 1 if the last jobs made
/// no progress.
bool resubmit_missing(SlurmFolder& folder, const SlurmPlan& plan, int& code) {
  const SlurmFolder::State state = folder.look(plan);
  if (state.missing.empty()) return false;
  fmt::print("{} of {} shards are not finished\n", state.missing.size(), plan.shards);
  code = advance_on_slurm(folder, false, own_array()) == SlurmStep::stuck ? 1 : 0;
  return true;
}

SlurmPlan plan_of(const SlurmFolder& folder) {
  const auto plan = folder.plan();
  if (!plan) throw Error("{} has no plan of a render", folder.path().string());
  return *plan;
}

/// Returns the number of blocks in a part. A part that cannot be continued is set aside: it holds
/// an hour of work at most, and a task that failed because of it would fail each time.
std::uint64_t usable_blocks(const fs::path& path) {
  if (!fs::exists(path)) return 0;
  try {
    const PartFile file(path);
    const BlockGrid& grid = file.header().grid;
    Film film(grid.width, grid.height, grid.block);
    file.add_to(film);
    return file.header().blocks.count();
  } catch (const Error& error) {
    fmt::print(stderr, "{}; its shard is rendered anew\n", error.what());
    fs::rename(path, path.string() + ".spoilt");
    return 0;
  }
}

/// Throws Error unless this node renders exactly what the plan says.
void require_same(const SlurmFolder& folder, const SlurmPlan& plan, const RenderSettings& mine) {
  for (const auto& [name, value] : mine) {
    const std::string& planned =
        name == "kernel" ? folder.settle_kernel(value) : plan.settings.at(name);
    if (planned == value) continue;
    throw Error(
        "on this node the {} is {}, the render's is {}{}", name, value, planned,
        name == "kernel" ? "; sbatch's --constraint (SBATCH_CONSTRAINT) keeps to like nodes" : "");
  }
}

}  // namespace

int run_slurm_task(const SlurmFolder& folder, const Scene& scene, const Integrator& integrator,
                   ShardRender render) {
  const SlurmPlan plan = plan_of(folder);
  const auto index = number_of<int>(variable("SLURM_ARRAY_TASK_ID"));
  if (!index || *index < 1 || *index > plan.shards)
    throw Error("there is no shard {} of {}", variable("SLURM_ARRAY_TASK_ID"), plan.shards);
  require_same(folder, plan, render.settings);
  render.threads = plan.threads;
  if (plan.adaptive()) return render_round_share(folder, plan, integrator, render, *index);
  const fs::path part = folder.part(*index);
  const std::uint64_t before = usable_blocks(part);
  render.shard = {static_cast<std::uint32_t>(*index), static_cast<std::uint32_t>(plan.shards)};
  render.output = part.string();
  render.quiet = true;
  const int code = render_shard(scene, integrator, render);
  if (code == 0) return 0;
  return end_early(code, PartFile(part).header().blocks.count() > before);
}

int run_slurm_merge(SlurmFolder& folder, const MergeOutput& how) {
  if (folder.done()) return 0;
  const SlurmPlan plan = plan_of(folder);
  if (int code = 0; resubmit_missing(folder, plan, code)) return code;
  std::vector<fs::path> parts;
  for (int i = 1; i <= plan.shards; ++i) {
    if (plan.share(i).count() > 0) parts.push_back(folder.part(i));
  }
  const std::string report = write_merged(Merge(parts), how);
  folder.finish(plan, with_suffix(output_stem(how.output, plan.scene), ".exr"), report);
  return 0;
}

int run_slurm_round_merge(SlurmFolder& folder, const Scene& scene, const Integrator& integrator,
                          ShardRender render, const MergeOutput& how) {
  if (folder.done()) return 0;
  const SlurmPlan plan = plan_of(folder);
  // The merge renders nothing, so its own processor does not matter.
  render.settings["kernel"] = folder.settle_kernel(integrator.name());
  if (int code = 0; resubmit_missing(folder, plan, code)) return code;
  const AdaptiveResult result = merge_round(folder, plan, integrator, render);
  if (!all_rounds_done(*result.state, render.spp)) {
    write_round(folder.round_state(folder.round() + 1), render.settings, *result.state, result);
    folder.next_round(plan);
    advance_on_slurm(folder, true, own_array());
    return 0;
  }
  const auto seed = number_of<std::uint64_t>(render.settings.at("seed")).value_or(0);
  RenderReport report = make_report(scene, plan.scene, integrator, seed, result);
  report.kernel = render.settings.at("kernel");
  add_target(report, result.summary);
  add_parts(report, static_cast<std::uint64_t>(plan.shards), 1);
  if (!how.reference.empty())
    report.reference = compare_with_reference(result, how.reference, read_exr(how.reference));
  const ResumableOutputs outputs(output_stem(how.output, plan.scene), render.settings, how.sums);
  outputs.write(result, report);
  ReportLines lines = to_lines(report);
  lines.emplace_back("written", outputs.names(result));
  folder.finish(plan, with_suffix(outputs.stem(), ".exr"), to_text(lines));
  return 0;
}

}  // namespace carlo
