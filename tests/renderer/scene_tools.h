#pragma once

#include "render/driver.h"
#include "render/scene_film.h"
#include "renderer/path_integrator.h"
#include "scene/scene.h"

#include <cmath>
#include <cstdint>

namespace scene_tools {

using namespace carlo;

/// A camera at `from` that looks at `at`; fov in degrees, of the width and the height.
inline Camera look_at(Vec3 from, Vec3 at, Vec3 up, double fov) {
  Camera camera;
  camera.origin = from;
  camera.forward = glm::normalize(at - from);
  camera.right = glm::normalize(glm::cross(camera.forward, up));
  camera.up = glm::cross(camera.right, camera.forward);
  camera.tan_half_x = camera.tan_half_y =
      static_cast<float>(std::tan(fov * 3.14159265358979 / 360));
  return camera;
}

inline RenderResult render_scene(const Scene& scene, std::uint32_t spp, std::uint64_t seed = 1,
                                 int threads = 0) {
  const auto integrator = renderer::make_path_integrator(scene, {.seed = seed, .spp = spp});
  return render(*integrator, scene.width, scene.height,
                {.spp = spp, .threads = threads, .progress = false});
}

}  // namespace scene_tools
