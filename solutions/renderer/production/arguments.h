#pragma once

#include "course/render/render_arguments.h"

#include <optional>
#include <string>

namespace carlo {

/// The reference renderer's command line: `render`, and how long, in shares or on a cluster.
struct ProductionArguments : RenderArguments {
  std::optional<double> target_error;
  std::string resume;
  double checkpoint = 60;
  bool no_sums = false;
  std::optional<std::string> shard;
  bool slurm = false, no_wait = false;
  std::optional<int> tasks;
  std::string time, partition;
  std::string slurm_task, slurm_merge;  ///< folders; for jobs alone
};

/// Those of `render` among them.
void add_production_options(CommandLine& app, ProductionArguments& a);

/// Refuses what does not go together. Throws Error.
void check(const ProductionArguments& a);

/// Changes the scene as the options say. Throws Error.
void apply(const ProductionArguments& a, Scene& scene);

}  // namespace carlo
