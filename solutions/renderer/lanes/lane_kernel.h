#pragma once

#include "render/integrator.h"
#include "render/splats.h"
#include "renderer/lanes/guide.h"
#include "renderer/lanes/lane_scene.h"
#include "scene/camera.h"

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace renderer {

/// Choices that do not change the mean of any pixel. The defaults have the least relMSE x seconds
/// on the Cornell boxes (`./carlo bench render --ablation`).
struct LaneChoices {
  float roulette_threshold = 0.25f;  ///< roulette ends paths below this throughput
  bool power_heuristic = true;       ///< otherwise the balance heuristic
  float light_paths = 0;             ///< number of light paths for each path from the camera
  bool share = false;        ///< pixels share what paths find (sharing-inl.h): see LaneJob::shares
  bool lights_apart = true;  ///< other rays than paths look for lights that pixels see directly
};

/// The pixels of a film from (x0, y0) to before (x1, y1).
struct FilmRectangle {
  int x0, y0, x1, y1;
};

/// Where pixels may see a light directly: a rectangle for each, if all are parallelograms, together
/// at most a sixteenth of the film (at the edges of larger ones there is less of the noise). None
/// if paths had better find that light themselves.
std::vector<FilmRectangle> seen_lights(const LaneScene& scene, const carlo::Camera& camera,
                                       int width, int height);

/// One call of the kernel: a tile of an image.
struct LaneJob {
  const LaneScene& scene;
  const carlo::Camera& camera;
  int width, height;  ///< of the film
  int max_depth;      ///< 0: no limit
  std::uint64_t seed;
  bool sobol;  ///< otherwise independent points
  const carlo::Tile& tile;
  const LaneChoices& choices;
  std::uint32_t blocks = 1;         ///< blocks of `tile.samples` samples, one after another
  const Guide* guide = nullptr;     ///< where camera paths find light, if that was learnt
  GuideLearner* learner = nullptr;  ///< learns it from this job, which then has no guide
  /// If not empty, paths leave out the light that their first segments meet, and other rays look
  /// for it in these pixels (straight-inl.h).
  std::span<const FilmRectangle> lights_apart = {};

  /// The samples of a pixel.
  std::uint32_t samples() const { return tile.samples * blocks; }
  /// True if pixels share what paths find: if that is chosen and allowed, and the scene suits it.
  bool shares() const {
    return choices.share && tile.share && choices.light_paths == 0 && scene.can_share();
  }
};

/// What camera paths alone would have found in place of a light path's splat. Summed over `count`
/// light paths, the squares are count x pixels times their part of E[X^2], X a sample of the pixel
/// by camera paths: however rare they are, light paths know how bright. (With f what a path carries
/// and p, q its densities from the camera and from the light, f^2 / p = (f / q)^2 q / p; here times
/// the splat's MIS weight, so that camera paths' own samples account for the rest.)
struct CameraMoment {
  std::uint64_t order;  ///< of light paths and their vertices
  std::uint32_t pixel;
  float root;
};

/// Light paths, connected to the camera at each vertex: they find light that mirrors and glass
/// focus, or that comes through a slit. MIS weights need the densities p of all three techniques
/// (camera paths, light sampling, light paths) for each path:
///
///   p(from lights) / p(from camera) = light_paths x pixels / pixel's density at the first vertex
///     x the reverse densities / the forward densities of all vertices x emission
///
/// all per area. Distances cancel, and at diffuse vertices so does everything but cosines.
/// Paths::mis_ratio is this quotient up to the last vertex, without the factors of its BRDF and of
/// the next direction. On light paths it is the inverse: the combined density of both techniques
/// from the camera over that of the light path. (Veach, Robust Monte Carlo methods, 1997, 10.2;
/// recursively as van Antwerpen, 2011.)
struct LightPathJob {
  const LaneJob& whole;                                 ///< its tile is ignored
  std::uint64_t first, count;                           ///< range of paths
  double unit;                                          ///< of the splats
  std::vector<CameraMoment>* camera_moments = nullptr;  ///< gets one for each splat, if wanted
};

/// Traces the paths; a splat is the radiance of a pixel times the number of all paths.
void trace_light_paths(const LightPathJob& job, carlo::Splats& splats, carlo::Counts& counts);

/// Renders a tile with the widest instruction set of this machine: the mean of the samples of each
/// pixel's blocks, pixel by pixel, row by row. One lane carries one path; lanes whose paths have
/// ended take the next samples, so that shading also runs on full vectors. The same job gives the
/// same bits on every instruction set.
void render_lanes(const LaneJob& job, std::span<std::array<double, 3>> means,
                  carlo::Counts& counts);

/// The instruction set of render_lanes(): "AVX3", "AVX2" ...
std::string lane_instruction_set();

/// All instruction sets that it can run on here, the widest first: none if the program was compiled
/// only for the widest set of another machine (CARLO_EVERY_INSTRUCTION_SET, CMakeLists.txt).
std::vector<std::string> lane_instruction_sets();

/// False on a processor without FMA (built before 2013), for which there is no kernel. True if the
/// program was compiled for another machine alone, so that it fails with an error instead of being
/// slow in silence.
bool lanes_suit_machine();

/// Makes render_lanes() use this instruction set from now on, for measurements and tests; ""
/// selects the widest again. Throws carlo::Error when this machine lacks it. Must not be called
/// during a render.
void use_instruction_set(const std::string& name);

}  // namespace renderer
