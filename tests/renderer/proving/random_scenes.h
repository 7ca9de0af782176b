#pragma once

#include "scene/scene.h"

#include <cstdint>

namespace proving {

/// Panels, boxes and balls of sizes from .01 to 3 around a camera, some of which shine, on a floor
/// or not, under a sky or not, in one of several scales. Nobody knows what the film should show;
/// all kernels must show the same.
carlo::Scene random_scene(std::uint64_t seed);

}  // namespace proving
