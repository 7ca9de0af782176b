#pragma once

#include "scene/scene.h"

#include <cstdint>

namespace proving {

/// Panels, boxes and balls of sizes from .01 to 3 around a camera, some of which emit, with or
/// without a floor and a sky, in one of several scales. The right image is unknown, but all kernels
/// must agree on it.
carlo::Scene random_scene(std::uint64_t seed);

}  // namespace proving
