#pragma once

#include "renderer/lanes/lane_kernel.h"
#include "renderer/lanes/lane_scene.h"
#include "scene/scene.h"

#include <cstdint>

namespace renderer {

/// True if a render of this scene should trace a light path for each path from the camera.
/// Both techniques are tried on an image of few pixels and compared by the relative variance of a
/// pixel times the number of rays. Always true where points shine on mirrors or glass: other paths
/// miss that light. The same seed and spp give the same answer. Traces about 0.6 % as many paths as
/// the render, and at least 25000.
bool try_light_paths(const carlo::Scene& scene, const LaneScene& lanes, std::uint64_t seed,
                     std::uint32_t spp);

}  // namespace renderer
