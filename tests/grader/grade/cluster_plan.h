#pragma once

#include "grader/grade/settings.h"

#include <filesystem>
#include <string>
#include <vector>

namespace carlo::grader {

/// The work of all tasks of an array, written once before it is submitted and read by each of them.
struct ClusterPlan {
  Settings settings = {};      ///< with absolute paths; the sandbox is a level
  std::string toolchain = {};  ///< required on a node
  std::string digest = {};     ///< of the course; nodes with another must not grade
  int tasks = 1;
  int workers = 1;                   ///< submissions at a time per task
  std::vector<Source> sources = {};  ///< still to be graded

  /// Returns the share of one task, from 1 to `tasks`: every `tasks`-th submission.
  std::vector<Source> share(int task) const;
};

/// Returns where an output folder keeps its arrays' files: the plan, the tasks' output, and the
/// nodes that have refused. No submission's folder begins with a dot.
std::filesystem::path cluster_folder(const std::filesystem::path& out);

std::filesystem::path plan_file(const std::filesystem::path& out);

void write_plan(const ClusterPlan& plan);
/// Throws Error if the file is not a plan.
ClusterPlan read_plan(const std::filesystem::path& file);

/// A node on which nobody can be graded, and why.
struct RefusedNode {
  std::string name, why;
};

/// Records it for an hour: by then the node may be fixed, or less busy.
void refuse_node(const std::filesystem::path& out, const RefusedNode& node);

std::vector<RefusedNode> refused_nodes(const std::filesystem::path& out);

}  // namespace carlo::grader
