#include "render/slurm_job.h"

#include "cli/error.h"
#include "cli/number.h"
#include "cli/program.h"
#include "render/interrupt.h"
#include "render/merge.h"
#include "render/outputs.h"
#include "render/part.h"
#include "render/slurm_render.h"

#include <fmt/core.h>

#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <system_error>
#include <vector>

namespace carlo {
namespace {

namespace fs = std::filesystem;

std::string variable(const char* name) {
  const char* const value = std::getenv(name);
  if (value == nullptr) throw Error("there is no {}: this is for Slurm's jobs alone", name);
  return value;
}

SlurmPlan plan_of(const SlurmFolder& folder) {
  const auto plan = folder.plan();
  if (!plan) throw Error("{} has no plan of a render", folder.path().string());
  return *plan;
}

/// The blocks that a part has. One that cannot be gone on with is put aside: so far it took an
/// hour at most, and a task that failed for it would fail each time.
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

/// What the plan says and this node does must be the same thing.
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
  const fs::path part = folder.part(*index);
  const std::uint64_t before = usable_blocks(part);
  render.shard = {static_cast<std::uint32_t>(*index), static_cast<std::uint32_t>(plan.shards)};
  render.output = part.string();
  render.threads = plan.threads;
  render.quiet = true;
  const int code = render_shard(scene, integrator, render);
  if (interrupt_signal() != SIGUSR1 || code == 0) return code;
  if (PartFile(part).header().blocks.count() == before)
    throw Error("time was up before a single block of samples was finished: --time is too short");
  fmt::print("time is up; queued again\n");
  output_of({"scontrol", "requeue", variable("SLURM_JOB_ID")});
  return 0;
}

int run_slurm_merge(SlurmFolder& folder, const MergeOutput& how) {
  if (folder.done()) return 0;
  const SlurmPlan plan = plan_of(folder);
  if (const auto state = folder.look(plan); !state.missing.empty()) {
    fmt::print("{} of {} shards are not finished\n", state.missing.size(), plan.shards);
    return advance_on_slurm(folder, false, variable("SLURM_ARRAY_JOB_ID")) == SlurmStep::stuck ? 1
                                                                                               : 0;
  }
  std::vector<fs::path> parts;
  for (int i = 1; i <= plan.shards; ++i) {
    if (plan.share(i).count() > 0) parts.push_back(folder.part(i));
  }
  const std::string report = write_merged(Merge(parts), how);
  folder.finish(plan, with_suffix(output_stem(how.output, plan.scene), ".exr"), report);
  return 0;
}

}  // namespace carlo
