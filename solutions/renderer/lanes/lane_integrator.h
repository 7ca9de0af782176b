#pragma once

#include "render/integrator.h"
#include "renderer/lanes/lane_kernel.h"
#include "scene/scene.h"

#include <cstdint>
#include <memory>
#include <optional>

namespace renderer {

/// The path tracer for scenes that suit LaneScene, with Sobol' or independent points: one path in
/// each lane of a vector register. If `pilot_spp`, the planned number of samples, is given, a pilot
/// decides whether to trace light paths (lane_integrator.cpp); otherwise the choices decide.
std::unique_ptr<carlo::Integrator> make_lane_integrator(
    const carlo::Scene& scene, std::uint64_t seed, const LaneChoices& choices,
    std::optional<std::uint32_t> pilot_spp = {});

}  // namespace renderer
