#pragma once

#include "render/integrator.h"
#include "renderer/production/block_set.h"
#include "renderer/production/settings.h"
#include "scene/scene.h"

#include <cstdint>
#include <string>

namespace carlo {

/// A share of a render, into a part.
struct ShardRender {
  Shard shard;
  std::string scene;   ///< its file
  std::string output;  ///< what -o said
  RenderSettings settings;
  std::uint32_t spp = 0;  ///< of the whole render
  int threads = 0;
  double checkpoint_seconds = 60;
  bool quiet = false;
};

/// Renders it, or the rest of it where its part is there and a killed run's. Returns the exit code;
/// throws Error, also if there is a part of anything else.
int render_shard(const Scene& scene, const Integrator& integrator, const ShardRender& render);

}  // namespace carlo
