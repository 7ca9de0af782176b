#pragma once

#include "render/integrator.h"
#include "renderer/lanes/lane_scene.h"
#include "scene/camera.h"

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace renderer {

/// Choices that leave the mean of every pixel as it is. The defaults have the least relMSE x
/// seconds on the Cornell boxes (`./carlo bench render --ablation`).
struct LaneChoices {
  float roulette_threshold = 0.25f;  ///< paths are ended by roulette below this throughput
  bool power_heuristic = true;       ///< or the balance heuristic
};

/// One call of the kernel: a tile of an image.
struct LaneJob {
  const LaneScene& scene;
  const carlo::Camera& camera;
  int width, height;  ///< of the film
  int max_depth;      ///< 0: no limit
  std::uint64_t seed;
  bool sobol;  ///< or independent points
  const carlo::Tile& tile;
  const LaneChoices& choices;
};

/// Renders a tile with the widest instruction set of this machine: the mean of the samples of each
/// pixel, row by row. One lane carries one path; lanes whose paths have ended take the next
/// samples, so that shading, too, runs on full vectors. The same job gives the same bits on the
/// same instruction set.
void render_lanes(const LaneJob& job, std::span<std::array<double, 3>> means,
                  carlo::Counts& counts);

/// "AVX3", "AVX2" ...: what render_lanes() runs on.
std::string lane_instruction_set();

/// All on which it can run here, the widest first.
std::vector<std::string> lane_instruction_sets();

/// From now on render_lanes() runs on this instruction set, for measurements and tests; "" is the
/// widest again. Throws carlo::Error when this machine lacks it. Not while a render is running.
void use_instruction_set(const std::string& name);

}  // namespace renderer
