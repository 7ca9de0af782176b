#include "renderer/production/slurm_round.h"

#include "course/cli/program.h"
#include "image/exr.h"
#include "render/interrupt.h"
#include "renderer/production/resume.h"
#include "support/error.h"

#include <fmt/core.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <system_error>

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

}  // namespace

std::string variable(const char* name) {
  const char* const value = std::getenv(name);
  if (value == nullptr) throw Error("{} is not set: only Slurm's jobs run this", name);
  return value;
}

int end_early(int code, bool further) {
  if (interrupt_signal() != SIGUSR1) return code;
  if (!further) throw Error("time was up before anything was finished: --time is too short");
  fmt::print("time is up; queued again\n");
  std::fflush(stdout);  // Slurm ends a job that it queues again
  output_of({"scontrol", "requeue", variable("SLURM_JOB_ID")});
  return 0;
}

void write_round(const fs::path& path, const RenderSettings& settings, const AdaptiveState& state,
                 const RenderResult& result) {
  ExrFile file{.image = state.film().mean()};
  RenderSettings attributes = settings;
  attributes["seconds"] = fmt::format("{}", result.seconds);
  add_sums(file, attributes, state, result.counts);
  write_exr(path, file);
}

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

}  // namespace carlo
