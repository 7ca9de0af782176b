#pragma once

#include "renderer/lanes/lane_kernel.h"
#include "renderer/lanes/lane_scene.h"
#include "scene/scene.h"

#include <cstdint>

namespace renderer {

/// Whether a render of this scene had best trace a path from a lamp for each path from the camera:
/// both ways are tried on an image of few pixels, and what counts is the relative variance of a
/// pixel times the number of rays. Where points shine on mirrors or glass it had: that light other
/// paths leave out. The same seed and spp give the same answer. It traces some .6 % as many paths
/// as the render, and 25000 at least.
bool try_lamp_paths(const carlo::Scene& scene, const LaneScene& lanes, std::uint64_t seed,
                    std::uint32_t spp);

}  // namespace renderer
