#pragma once

#include "render/integrator.h"
#include "render/splats.h"
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
  float lamp_paths = 0;              ///< paths from lamps for each from the camera
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

/// Paths from lamps, which are joined to the camera at each vertex: light that mirrors and glass
/// gather, or that comes through a slit, is found from there. Of each path both techniques, and
/// light sampling, know the densities p of all:
///
///   p(from lamps) / p(from camera) = lamp_paths x pixels / pixel's density at the first vertex
///     x the densities along the way back / those along the way there x emission
///
/// per area all of them. Lengths drop out, and at diffuse vertices all but cosines: Paths::rival
/// carries that quotient up to the last vertex, without what its BRDF and the next direction add.
/// On paths from lamps it is the other way round, that of the techniques from the camera together.
/// (Veach, Robust Monte Carlo methods, 1997, 10.2; recursively as van Antwerpen, 2011.)
struct LampJob {
  const LaneJob& whole;        ///< its tile does not matter
  std::uint64_t first, count;  ///< which of the paths
  double unit;                 ///< of the splats
};

/// Traces them; a splat is the radiance of a pixel times the number of all paths.
void trace_lamps(const LampJob& job, carlo::Splats& splats, carlo::Counts& counts);

/// Renders a tile with the widest instruction set of this machine: the mean of the samples of each
/// pixel, row by row. One lane carries one path; lanes whose paths have ended take the next
/// samples, so that shading, too, runs on full vectors. The same job gives the same bits on all of
/// them.
void render_lanes(const LaneJob& job, std::span<std::array<double, 3>> means,
                  carlo::Counts& counts);

/// "AVX3", "AVX2" ...: what render_lanes() runs on.
std::string lane_instruction_set();

/// All on which it can run here, the widest first: none where the program was compiled for the
/// widest of another machine alone (CARLO_EVERY_INSTRUCTION_SET, CMakeLists.txt).
std::vector<std::string> lane_instruction_sets();

/// False on a processor without FMA (built before 2013), for which there is no kernel. True where
/// the program was compiled for another machine alone: to say so is better than to be slow in
/// silence.
bool lanes_suit_machine();

/// From now on render_lanes() runs on this instruction set, for measurements and tests; "" is the
/// widest again. Throws carlo::Error when this machine lacks it. Not while a render is running.
void use_instruction_set(const std::string& name);

}  // namespace renderer
