// `./carlo render`: the reference renderer.

#include "course/cli/arguments.h"
#include "course/cli/main_guard.h"
#include "renderer/path_integrator.h"
#include "renderer/production/render_command.h"

#include <cstdint>
#include <optional>
#include <string>

namespace {

/// `light_paths`: the explicit choice, if one was made.
renderer::Technique technique_of(const std::string& name, std::optional<bool> light_paths) {
  if (light_paths)
    return *light_paths ? renderer::Technique::bidirectional : renderer::Technique::path;
  if (name == "path") return renderer::Technique::path;
  if (name == "bidirectional") return renderer::Technique::bidirectional;
  return renderer::Technique::automatic;
}

}  // namespace

int main(int argc, char** argv) {
  return carlo::run_main([&] {
    std::string kernel = "best";
    std::string technique = "auto";
    return carlo::render_command(
        argc, argv,
        [&](const carlo::Scene& scene, const carlo::RenderPlan& plan) {
          const auto choice =
              kernel == "scalar" ? renderer::Kernel::scalar : renderer::Kernel::best;
          return renderer::make_path_integrator(
              scene, {.seed = plan.seed,
                      .spp = plan.spp,
                      .kernel = choice,
                      .technique = technique_of(technique, plan.light_paths),
                      .guidance = technique == "auto" ? renderer::Guidance::automatic
                                                      : renderer::Guidance::none,
                      .share = technique == "auto" && !plan.to_target});
        },
        [&](carlo::CommandLine& app) {
          app.option("--kernel", kernel,
                     "best: what suits the scene; scalar: the one that renders all scenes")
              .one_of({"best", "scalar"})
              .show_default();
          app.option("--technique", technique,
                     "path: all paths start at the camera; bidirectional: some at the lights, for "
                     "caustics and hidden lights; auto: the better by a short trial; paths guided "
                     "to where light was found, and pixels that share what their paths find, where "
                     "others find that it pays")
              .one_of({"auto", "path", "bidirectional"})
              .show_default();
          app.footer("./carlo render --mine ... renders by your own lab 8.");
        });
  });
}
