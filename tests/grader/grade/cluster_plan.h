#pragma once

#include "grader/grade/settings.h"

#include <filesystem>
#include <string>
#include <vector>

namespace carlo::grader {

/// What the tasks of one array do, written once before it is submitted and read by each of them.
struct ClusterPlan {
  Settings settings = {};      ///< paths are whole; the sandbox is a level
  std::string toolchain = {};  ///< that a node must have
  std::string digest = {};     ///< of the course; of another one a node must not grade
  int tasks = 1;
  int workers = 1;                   ///< submissions at a time in a task
  std::vector<Source> sources = {};  ///< still to be graded

  /// The share of one task, from 1 to `tasks`: every `tasks`-th submission.
  std::vector<Source> share(int task) const;
};

/// Where an output folder keeps what its arrays need: the plan, the tasks' output, and which nodes
/// have refused. No submission's folder begins with a dot.
std::filesystem::path cluster_folder(const std::filesystem::path& out);

std::filesystem::path plan_file(const std::filesystem::path& out);

void write_plan(const ClusterPlan& plan);
/// Throws Error when the file is none.
ClusterPlan read_plan(const std::filesystem::path& file);

/// A node on which nobody can be graded, and why.
struct RefusedNode {
  std::string name, why;
};

/// Notes it for an hour: then a node may have been mended, or be less busy.
void refuse_node(const std::filesystem::path& out, const RefusedNode& node);

std::vector<RefusedNode> refused_nodes(const std::filesystem::path& out);

}  // namespace carlo::grader
