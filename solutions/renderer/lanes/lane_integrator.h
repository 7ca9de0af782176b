#pragma once

#include "render/integrator.h"
#include "renderer/lanes/guide.h"
#include "renderer/lanes/lane_kernel.h"
#include "renderer/lanes/lane_scene.h"
#include "scene/scene.h"

#include <cstdint>
#include <memory>
#include <optional>

namespace renderer {

/// Whether camera paths are guided to where light was found (guide.h): never, or if a short trial
/// finds that it pays, or always.
enum class Guidance { none, automatic, always };

/// What short trials decide, for this planned number of samples per pixel.
struct LaneTrials {
  std::uint32_t spp = 64;
  bool light_paths = false;  ///< whether to trace them; otherwise the choices say so
  Guidance guidance = Guidance::none;
  bool share = false;  ///< whether pixels share what paths find; otherwise the choices say so

  bool any() const { return light_paths || guidance != Guidance::none || share; }
};

/// The number of light paths for each path from the camera that costs least relMSE x seconds in
/// `rare_paths`, `cornell_phong` and `caustics`: light that mirrors, glass and lobes focus needs
/// fewer than light that comes through a slit and is everywhere after that. What only light paths
/// find gets as many as camera paths. Powers of two, for Sobol' points.
float light_paths_per_path(const LaneScene& lanes);

/// Runs the trials and sets what they decide in `choices`. Returns where paths find light, if they
/// are to be guided by that.
std::optional<Guide> decide(const carlo::Scene& scene, const LaneScene& lanes, std::uint64_t seed,
                            const LaneTrials& trials, LaneChoices& choices);

/// The path tracer for scenes that suit LaneScene, with Sobol' or independent points: one path in
/// each lane of a vector register.
std::unique_ptr<carlo::Integrator> make_lane_integrator(const carlo::Scene& scene,
                                                        std::uint64_t seed,
                                                        const LaneChoices& choices,
                                                        const LaneTrials& trials = {});

}  // namespace renderer
