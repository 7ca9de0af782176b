#pragma once

#include "lane_scenes.h"
#include "tiles.h"

namespace oracle {

constexpr int size = 32, tile = 8;

/// The scene rendered by the scalar integrator, size x size pixels, tile by tile: 1024 independent
/// samples per pixel, seed 99. Rendered once per program and name, since it takes longer than what
/// is compared with it.
const tiles::Estimate& of(const lane_scenes::Named& scene);

}  // namespace oracle
