#pragma once

#include "renderer/production/slurm_folder.h"

#include <string>

// Whoever submits a render to a cluster, and waits for it.

namespace carlo {

enum class SlurmStep { done, under_way, submitted, stuck };

/// Submits what is missing: an array of the shards that are not finished, and behind it their
/// merge; nothing while jobs of this render wait or run (`but_for`: other than this one). Unless it
/// is `asked_for`, nothing either where the last jobs came to nothing (stuck). For one process at a
/// time; of two on machines whose locks do not know each other, Slurm's numbers decide. Throws
/// Error.
SlurmStep advance_on_slurm(SlurmFolder& folder, bool asked_for, const std::string& but_for = "");

struct SlurmRender {
  SlurmPlan plan;
  bool tasks_given = false;  ///< or plan.shards is that of the render that was begun
  bool wait = true, quiet = false;
};

/// Begins or goes on with the render of this folder, and waits for it or says how to. Returns the
/// exit code; throws Error.
int render_on_slurm(SlurmFolder& folder, SlurmRender render);

}  // namespace carlo
