#pragma once

#include "course/render/render_arguments.h"

#include <optional>
#include <string>

namespace carlo {

/// The reference renderer's command line: that of `render`, with target errors, resuming, shares
/// and clusters.
struct ProductionArguments : RenderArguments {
  std::optional<double> target_error;
  std::string resume;
  double checkpoint = 60;
  bool no_sums = false;
  std::optional<std::string> shard;
  bool slurm = false, no_wait = false;
  std::optional<int> tasks;
  std::string time, partition;
  std::string slurm_task, slurm_merge;  ///< folders; set by jobs only
};

/// Adds all options, including those of `render`.
void add_production_options(CommandLine& app, ProductionArguments& a);

/// Rejects options that do not go together. Throws Error.
void check(const ProductionArguments& a);

/// Changes the scene according to the options. Throws Error.
void apply(const ProductionArguments& a, Scene& scene);

}  // namespace carlo
