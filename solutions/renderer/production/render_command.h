#pragma once

#include "render/integrator.h"
#include "scene/scene.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>

namespace carlo {

class CommandLine;

/// What an integrator is for.
struct RenderPlan {
  std::uint64_t seed = 1;
  std::uint32_t spp = 64;                ///< planned samples per pixel
  bool to_target = false;                ///< until each pixel has an error below a target
  std::optional<bool> light_paths = {};  ///< whether it traces them, if that was decided before
};
/// Makes an integrator for a scene.
using ProductionFactory =
    std::function<std::unique_ptr<Integrator>(const Scene& scene, const RenderPlan& plan)>;

/// The command `render` of the reference renderer: like render_app() (course/render), with target
/// errors, resuming, shares and clusters. Returns the exit code; throws Error.
int render_command(int argc, char** argv, const ProductionFactory& factory,
                   const std::function<void(CommandLine&)>& add_options);

}  // namespace carlo
