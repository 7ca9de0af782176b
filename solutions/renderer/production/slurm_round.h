#pragma once

#include "renderer/production/adaptive.h"
#include "renderer/production/shard_render.h"
#include "renderer/production/slurm_folder.h"

#include <filesystem>
#include <string>

// Rounds of a render with a target error, by the jobs of a cluster.

namespace carlo {

/// A variable of the environment in which Slurm's jobs run. Throws Error.
std::string variable(const char* name);

/// What a task that was interrupted returns: 0 when its time was up (SIGUSR1) and it is queued
/// again, `code` after another signal. Throws Error if its time was up and it got no further.
int end_early(int code, bool further);

/// A share of the round at work, or the rest of it. Returns the exit code; throws Error.
int render_round_share(const SlurmFolder& folder, const SlurmPlan& plan,
                       const Integrator& integrator, const ShardRender& render, int shard);

/// All shares of the round at work, and what they decide. Throws Error if one cannot be read.
AdaptiveResult merge_round(const SlurmFolder& folder, const SlurmPlan& plan,
                           const Integrator& integrator, const ShardRender& render);

/// Writes a state, or what a share has of it, with the counts and the time of `result`.
void write_round(const std::filesystem::path& path, const RenderSettings& settings,
                 const AdaptiveState& state, const RenderResult& result);

}  // namespace carlo
