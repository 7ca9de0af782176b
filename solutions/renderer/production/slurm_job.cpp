#include "renderer/production/slurm_job.h"

#include "course/render/outputs.h"
#include "course/render/report.h"
#include "image/exr.h"
#include "renderer/production/merge.h"
#include "renderer/production/part.h"
#include "renderer/production/reports.h"
#include "renderer/production/resumable_outputs.h"
#include "renderer/production/slurm_render.h"
#include "renderer/production/slurm_round.h"
#include "support/error.h"
#include "support/number.h"

#include <fmt/core.h>

#include <cstdint>
#include <vector>

namespace carlo {
namespace {

namespace fs = std::filesystem;

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
