#pragma once

#include "renderer/production/merge_image.h"
#include "renderer/production/shard_render.h"
#include "renderer/production/slurm_folder.h"

// The work of the jobs of a render on a cluster.

namespace carlo {

/// Renders the share given by SLURM_ARRAY_TASK_ID, or the rest of it. When time is up (SIGUSR1),
/// the task is queued again if it made progress. Returns the exit code; throws Error.
int run_slurm_task(const SlurmFolder& folder, const Scene& scene, const Integrator& integrator,
                   ShardRender render);

/// Runs after the tasks of a render without a target error: merges their parts into the image, or
/// submits the missing shards again if there was progress. Returns the exit code; throws Error.
int run_slurm_merge(SlurmFolder& folder, const MergeOutput& how);

/// The same with a target error: merges a round, makes its decisions, and submits the next round or
/// writes the image.
int run_slurm_round_merge(SlurmFolder& folder, const Scene& scene, const Integrator& integrator,
                          ShardRender render, const MergeOutput& how);

}  // namespace carlo
