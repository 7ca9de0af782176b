#pragma once

#include "render/integrator.h"
#include "renderer/flat/flat_scene.h"
#include "scene/camera.h"

#include <array>
#include <cstdint>
#include <span>
#include <string>

namespace renderer {

/// One call of the kernel: a tile of an image.
struct FlatJob {
  const FlatScene& scene;
  const carlo::Camera& camera;
  int width, height;  ///< of the film
  int max_depth;      ///< 0: no limit
  std::uint64_t seed;
  bool sobol;  ///< or independent points
  const carlo::Tile& tile;
};

/// Renders a tile with the widest instruction set of this machine: the mean of the samples of each
/// pixel, row by row. One lane carries one path; lanes whose paths have ended take the next
/// samples, so that shading, too, runs on full vectors. The same job gives the same bits on the
/// same instruction set.
void render_flat(const FlatJob& job, std::span<std::array<double, 3>> means, carlo::Counts& counts);

/// "AVX3", "AVX2" ...: what render_flat() runs on.
std::string flat_instruction_set();

}  // namespace renderer
