#pragma once

#include "render/integrator.h"
#include "scene/scene.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>

namespace carlo {

class CommandLine;

/// Makes an integrator for a scene; `spp` is the planned number of samples per pixel, `light_paths`
/// says whether it traces light paths, if that was decided before.
using ProductionFactory = std::function<std::unique_ptr<Integrator>(
    const Scene& scene, std::uint64_t seed, std::uint32_t spp, std::optional<bool> light_paths)>;

/// The command `render` of the reference renderer: like render_app() (course/render), with target
/// errors, resuming, shares and clusters. Returns the exit code; throws Error.
int render_command(int argc, char** argv, const ProductionFactory& factory,
                   const std::function<void(CommandLine&)>& add_options);

}  // namespace carlo
