#pragma once

#include "render/integrator.h"
#include "renderer/lanes/lane_kernel.h"
#include "scene/scene.h"

#include <cstdint>
#include <memory>

namespace renderer {

/// Whether camera paths are guided to where light was found (guide.h): never, or if a short trial
/// finds that it pays, or always.
enum class Guidance { none, automatic, always };

/// What short trials decide (lane_integrator.cpp), for this planned number of samples per pixel.
struct LaneTrials {
  std::uint32_t spp = 64;
  bool light_paths = false;  ///< whether to trace them; otherwise the choices say so
  Guidance guidance = Guidance::none;

  bool any() const { return light_paths || guidance != Guidance::none; }
};

/// The path tracer for scenes that suit LaneScene, with Sobol' or independent points: one path in
/// each lane of a vector register.
std::unique_ptr<carlo::Integrator> make_lane_integrator(const carlo::Scene& scene,
                                                        std::uint64_t seed,
                                                        const LaneChoices& choices,
                                                        const LaneTrials& trials = {});

}  // namespace renderer
