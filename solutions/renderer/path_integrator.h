#pragma once

#include "render/integrator.h"
#include "renderer/lanes/lane_integrator.h"
#include "renderer/lanes/lane_kernel.h"
#include "scene/scene.h"

#include <cstdint>
#include <memory>

namespace renderer {

/// The code that renders: the best for the scene, or the scalar kernel, which renders all scenes.
enum class Kernel { best, scalar };

/// The starts of paths: all at the camera, or some at the lights as well (lanes/lane_kernel.h), or
/// whichever a short pilot finds better. The scalar kernel supports only the first.
enum class Technique { path, bidirectional, automatic };

struct PathOptions {
  std::uint64_t seed = 1;
  std::uint32_t spp = 64;  ///< planned samples per pixel, for the stratified sampler
  Kernel kernel = Kernel::best;
  Technique technique = Technique::path;
  Guidance guidance = Guidance::none;  ///< by the vector kernel
  /// Pixels may share what their paths find, by the vector kernel, if a short trial finds that it
  /// pays; where a tile allows it.
  bool share = false;
  LaneChoices choices{};  ///< for the vector kernel, for measurements
};

/// The iterative path tracer: emission added at every hit, next-event estimation and BRDF sampling
/// combined by the power heuristic, Russian roulette on the throughput (so absorption ends paths),
/// mirrors and glass by their deterministic directions. Scenes of up to 65536 shapes go to the
/// vector kernel (lanes/), unless options ask for the scalar one. Keeps a reference to `scene`,
/// which must outlive the integrator.
std::unique_ptr<carlo::Integrator> make_path_integrator(const carlo::Scene& scene,
                                                        const PathOptions& options);

/// True if Technique::bidirectional can render this scene; for others it is an error.
bool light_paths_suit(const carlo::Scene& scene);

}  // namespace renderer
