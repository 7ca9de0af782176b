#pragma once

#include "render/integrator.h"
#include "renderer/production/block_set.h"
#include "renderer/production/resume.h"
#include "scene/scene.h"

#include <cstdint>
#include <string>

namespace carlo {

/// How to render a share of a render into a part.
struct ShardRender {
  Shard shard;
  std::string scene;   ///< path of its file
  std::string output;  ///< value of -o
  RenderSettings settings;
  std::uint32_t spp = 0;  ///< of the whole render
  int threads = 0;
  double checkpoint_seconds = 60;
  bool quiet = false;
};

/// Renders the share, or the rest of it if a killed run left its part. Returns the exit code;
/// throws Error, also if the file holds a part of anything else.
int render_shard(const Scene& scene, const Integrator& integrator, const ShardRender& render);

}  // namespace carlo
