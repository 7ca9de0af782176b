#pragma once

#include "render/integrator.h"
#include "renderer/lanes/lane_kernel.h"
#include "scene/scene.h"

#include <cstdint>
#include <memory>

namespace renderer {

/// The path tracer for scenes that LaneScene suits, with Sobol' or independent points: brute force
/// over all surfaces, a path in each lane of a vector register.
std::unique_ptr<carlo::Integrator> make_lane_integrator(const carlo::Scene& scene,
                                                        std::uint64_t seed,
                                                        const LaneChoices& choices);

}  // namespace renderer
