#pragma once

#include "lane_scenes.h"
#include "render/scene_film.h"
#include "renderer/path_integrator.h"
#include "tiles.h"

#include <map>
#include <string>

namespace oracle {

constexpr int size = 32, tile = 8;

/// The scene rendered by the scalar integrator, size x size pixels, tile by tile: 1024 independent
/// samples per pixel, seed 99. Rendered once per program and name, since it takes longer than what
/// is compared with it.
inline const tiles::Estimate& of(const lane_scenes::Named& scene) {
  static std::map<std::string, tiles::Estimate> known;
  const auto found = known.find(scene.name);
  if (found != known.end()) return found->second;
  constexpr tiles::Samples samples{32, 32};
  carlo::Scene small = scene.scene;
  resize(small, size, size);
  small.sampler = carlo::SamplerKind::independent;
  const auto scalar = renderer::make_path_integrator(
      small, {.seed = 99, .spp = samples.per_pixel(), .kernel = renderer::Kernel::scalar});
  return known[scene.name] = tiles::estimate(*scalar, size, tile, samples);
}

}  // namespace oracle
