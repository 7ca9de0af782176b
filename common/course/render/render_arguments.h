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
  std::optional<double> seconds;
  std::optional<int> max_depth;
  std::optional<std::string> page;
  std::optional<std::uint64_t> seed;
  int threads = 0;
  bool quiet = false;
};

void add_render_options(CommandLine& app, RenderArguments& a);

/// Treats SCENE.xml in `--page SCENE.xml` as the scene, not the page. Throws Error.
void tell_page_from_scene(RenderArguments& a);

/// Sets the default scene if none is given. Throws Error if there is none.
void settle_scene(RenderArguments& a);

/// Parses the arguments of -D. Throws Error.
std::map<std::string, std::string> parse_definitions(const std::vector<std::string>& definitions);

/// Changes the scene according to the options. Throws Error.
void apply(const RenderArguments& a, Scene& scene);

/// Returns the path of the page, if one is wanted.
std::optional<std::filesystem::path> page_path(const RenderArguments& a,
                                               const std::filesystem::path& stem);

}  // namespace carlo
