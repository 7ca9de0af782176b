#pragma once

#include "render/integrator.h"
#include "renderer/flat/flat_kernel.h"
#include "scene/scene.h"

#include <cstdint>
#include <memory>

namespace renderer {

/// The path tracer for scenes that FlatScene suits, with Sobol' or independent points: brute force
/// over all surfaces, a path in each lane of a vector register.
std::unique_ptr<carlo::Integrator> make_flat_integrator(const carlo::Scene& scene,
                                                        std::uint64_t seed,
                                                        const FlatChoices& choices);

}  // namespace renderer
