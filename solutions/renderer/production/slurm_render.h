#pragma once

#include "renderer/production/slurm_folder.h"

#include <string>

// Submitting a render to a cluster and waiting for it.

namespace carlo {

enum class SlurmStep { done, under_way, submitted, stuck };

/// Submits the missing work: an array of the unfinished shards, and their merge after it. Submits
/// nothing while jobs of this render other than `but_for` wait or run, nor, unless it is
/// `asked_for`, if the last jobs made no progress (stuck). Only one process may call it at a time;
/// of two on machines whose locks do not reach each other, the one with the lower job id wins.
/// Throws Error.
SlurmStep advance_on_slurm(SlurmFolder& folder, bool asked_for, const std::string& but_for = "");

struct SlurmRender {
  SlurmPlan plan;
  bool tasks_given = false;  ///< otherwise plan.shards is that of the render that was begun
  bool wait = true, quiet = false;
};

/// Begins or continues the render of this folder, and waits for it or says how to. Returns the exit
/// code; throws Error.
int render_on_slurm(SlurmFolder& folder, SlurmRender render);

}  // namespace carlo
