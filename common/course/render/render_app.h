#pragma once

#include "render/integrator.h"
#include "scene/scene.h"

#include <cstdint>
#include <functional>
#include <memory>

namespace carlo {

class CommandLine;

/// Makes an integrator for a scene; `spp` is the planned number of samples per pixel.
using IntegratorFactory = std::function<std::unique_ptr<Integrator>(
    const Scene& scene, std::uint64_t seed, std::uint32_t spp)>;

/// The command `render SCENE ...` for any integrator: loads the scene, renders, writes PNG, EXR and
/// JSON and prints the report. `add_options` may add options of the integrator; they are read
/// before the factory is called. Returns the exit code; throws Error.
int render_app(int argc, char** argv, const IntegratorFactory& factory,
               const std::function<void(CommandLine&)>& add_options = {});

}  // namespace carlo
