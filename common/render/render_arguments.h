#pragma once

#include "scene/scene.h"

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace carlo {

class CommandLine;

/// The command line of `render`.
struct RenderArguments {
  std::string scene, default_scene, output, reference, size, sampler;
  std::vector<std::string> definitions;
  std::optional<std::uint32_t> spp;
  std::optional<double> seconds, target_error;
  std::optional<int> max_depth;
  std::optional<std::string> page;
  std::optional<std::uint64_t> seed;
  int threads = 0;
  bool quiet = false;
  std::string resume;
  double checkpoint = 60;
  bool no_sums = false;
  std::optional<std::string> shard;
  bool slurm = false, no_wait = false;
  std::optional<int> tasks;
  std::string time, partition;
  std::string slurm_task, slurm_merge;  ///< folders; for jobs alone
};

void add_options(CommandLine& app, RenderArguments& a);

/// `--page SCENE.xml` names the scene, not the page.
void tell_page_from_scene(RenderArguments& a);

/// Refuses what does not go together. Throws Error.
void check(const RenderArguments& a);

/// From the words behind -D. Throws Error.
std::map<std::string, std::string> parse_definitions(const std::vector<std::string>& definitions);

/// Changes the scene as the options say. Throws Error.
void apply(const RenderArguments& a, Scene& scene);

/// Where the page goes, if one is wanted.
std::optional<std::filesystem::path> page_path(const RenderArguments& a,
                                               const std::filesystem::path& stem);

}  // namespace carlo
