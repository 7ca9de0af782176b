#pragma once

#include "course/slurm/folder_lock.h"
#include "grader/grade/cluster_plan.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

// Grades a class as an array of Slurm jobs. Whatever fails at any moment: existing records are
// right, and the same command grades the others. Slurm knows which tasks are running, by the job
// name of an output folder.

namespace carlo::grader {

struct ClusterOptions {
  int tasks = 0;  ///< 0: a suitable number
  std::string time = {}, partition = {};
  int workers = 1;
  bool wait = true;
};

/// A class that the cluster has graded, and the lock on its folder.
struct ClusterClass {
  slurm::FolderLock lock;
  std::vector<Record> records;  ///< in the order of the submissions; missing ones without marks
};

/// Submits what is still to be graded and waits for it, in as many arrays as make progress. With
/// `wait` off, returns nothing while there is something to wait for, after printing the command for
/// later. Throws Error.
std::optional<ClusterClass> grade_on_cluster(const Course& course, const Settings& settings,
                                             const std::vector<Source>& sources,
                                             const ClusterOptions& options);

/// Returns the level of the sandbox required of all nodes: the one that is named, or the strongest
/// of this machine. Throws Error if there is none.
Sandbox sandbox_for_nodes(const Settings& settings, const CleanTree& clean);

/// Runs one task of an array: its share of the plan. Returns 0 if all of it has marks. Throws Error
/// if this node must not grade, which is recorded for others.
int run_cluster_task(const std::filesystem::path& plan_file);

}  // namespace carlo::grader
