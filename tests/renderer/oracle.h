#pragma once

#include "lane_scenes.h"
#include "tiles.h"

namespace oracle {

constexpr int size = 32, tile = 8;

/// The scene by the scalar integrator, size x size pixels, tile by tile: 1024 independent samples a
/// pixel, seed 99. Once in a program for each name: it takes longer than what is compared with it.
const tiles::Estimate& of(const lane_scenes::Named& scene);

}  // namespace oracle
