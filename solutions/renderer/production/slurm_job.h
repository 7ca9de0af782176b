#pragma once

#include "renderer/production/merge_image.h"
#include "renderer/production/shard_render.h"
#include "renderer/production/slurm_folder.h"

// What the jobs of a render on a cluster do.

namespace carlo {

/// The task's share, SLURM_ARRAY_TASK_ID says which, or the rest of it. When time is up (SIGUSR1)
/// it is queued again, if it got any further. Returns the exit code; throws Error.
int run_slurm_task(const SlurmFolder& folder, const Scene& scene, const Integrator& integrator,
                   ShardRender render);

/// When tasks have ended, of a render without a target error: merges what they made to the image,
/// or submits again what is missing, if they got any further. Returns the exit code; throws Error.
int run_slurm_merge(SlurmFolder& folder, const MergeOutput& how);

/// The same with a target error: puts a round together, decides, and submits the next one or writes
/// the image.
int run_slurm_round_merge(SlurmFolder& folder, const Scene& scene, const Integrator& integrator,
                          ShardRender render, const MergeOutput& how);

}  // namespace carlo
