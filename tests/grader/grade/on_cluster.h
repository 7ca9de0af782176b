#pragma once

#include "course/slurm/folder_lock.h"
#include "grader/grade/cluster_plan.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

// A class as an array of Slurm jobs. Whatever dies at whatever moment: records that are there are
// right, and the same command grades the others. What is at work is Slurm's to say, by the name of
// the jobs of an output folder.

namespace carlo::grader {

struct ClusterOptions {
  int tasks = 0;  ///< 0: as many as are good
  std::string time = {}, partition = {};
  int workers = 1;
  bool wait = true;
};

/// A class that the cluster has graded, and the lock of its folder.
struct ClusterClass {
  slurm::FolderLock lock;
  std::vector<Record>
      records;  ///< in the order of the submissions; without marks where there are none
};

/// Submits what is still to be graded and waits for it, in as many arrays as bring anything new.
/// Nothing with `wait` off, while there is something to be waited for; what to type later has been
/// said. Throws Error.
std::optional<ClusterClass> grade_on_cluster(const Course& course, const Settings& settings,
                                             const std::vector<Source>& sources,
                                             const ClusterOptions& options);

/// The level of the sandbox that all nodes are held to: the one that is named, or the strongest of
/// this machine. Throws Error when that is none.
Sandbox sandbox_for_nodes(const Settings& settings, const CleanTree& clean);

/// One task of an array: its share of the plan. Returns 0 when all of it has marks. Throws Error
/// when this node may grade nobody, which is noted for others.
int run_cluster_task(const std::filesystem::path& plan_file);

}  // namespace carlo::grader
