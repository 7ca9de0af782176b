#pragma once

#include "renderer/production/adaptive.h"
#include "renderer/production/shard_render.h"
#include "renderer/production/slurm_folder.h"

#include <filesystem>
#include <string>

// Rounds of a render with a target error, done by the jobs of a cluster.

namespace carlo {

/// Returns a variable of the environment of Slurm's jobs. Throws Error if it is not set.
std::string variable(const char* name);

/// Returns the exit code of an interrupted task: 0 if its time was up (SIGUSR1), after queueing it
/// again, else `code`. Throws Error if its time was up without progress.
int end_early(int code, bool further);

/// Renders a share of the current round, or the rest of it. Returns the exit code; throws Error.
int render_round_share(const SlurmFolder& folder, const SlurmPlan& plan,
                       const Integrator& integrator, const ShardRender& render, int shard);

/// Merges all shares of the current round and makes its decisions. Throws Error if one cannot be
/// read.
AdaptiveResult merge_round(const SlurmFolder& folder, const SlurmPlan& plan,
                           const Integrator& integrator, const ShardRender& render);

/// Writes a state, or a share's part of it, with the counts and the time of `result`.
void write_round(const std::filesystem::path& path, const RenderSettings& settings,
                 const AdaptiveState& state, const RenderResult& result);

}  // namespace carlo
