#include "hard_case.h"
#include "render/driver.h"
#include "render/scene_film.h"
#include "renderer/path_integrator.h"

#include <fmt/core.h>

#include <cmath>

namespace hard_cases {
namespace {

using carlo::Rgb;
using carlo::Scene;

/// Seen from inside a sphere that emits 1 and has this albedo.
Scene furnace(float albedo) {
  Scene scene;
  scene.width = scene.height = 16;
  scene.sampler = carlo::SamplerKind::independent;
  scene.materials.push_back({carlo::Diffuse{Rgb(albedo)}, false});
  scene.shapes.push_back({carlo::Sphere{{0, 0, 0}, 1, true}, 0, Rgb(1)});
  scene.camera.fit_film(16, 16);
  return scene;
}

carlo::RenderResult render(const Scene& scene, std::uint32_t spp, int threads) {
  const auto integrator = renderer::make_path_integrator(scene, {.seed = 29, .spp = spp});
  return carlo::render(*integrator, scene.width, scene.height,
                       {.spp = spp, .threads = threads, .progress = false});
}

HardCase depth_cap() {
  Scene capped = furnace(0.9f);
  capped.max_depth = 9;
  const double naive = carlo::mean_radiance(render(capped, 64, 0).film).value[0];
  const carlo::MeanRadiance ours = carlo::mean_radiance(render(furnace(0.9f), 1024, 0).film);
  return {
      29,
      "a furnace of albedo .9",
      fmt::format("{:.2f} (9 segments)", naive),
      fmt::format("{:.3f} +- {:.3f}", ours.value[0], ours.standard_error[0]),
      "10 +- 4 se",
      std::abs(ours.value[0] - 10) <= 4 * ours.standard_error[0] && ours.standard_error[0] < 0.05};
}

HardCase long_paths() {
  float naive = 1;
  int steps = 0;
  for (; naive >= 1.17549435e-38f; ++steps)
    naive *= 0.5f;
  const carlo::RenderResult result = render(furnace(0.999f), 16, 0);
  const carlo::MeanRadiance ours = carlo::mean_radiance(result.film);
  return {30,
          "throughput of long paths (albedo .999)",
          fmt::format("denormal at {}", steps),
          fmt::format("{:.0f} +- {:.0f}, {} bad", ours.value[0], ours.standard_error[0],
                      result.counts.bad),
          "1000 +- 4 se, 0 bad",
          result.counts.bad == 0 && std::abs(ours.value[0] - 1000) <= 4 * ours.standard_error[0]};
}

HardCase same_bits() {
  const Scene scene = furnace(0.5f);
  const carlo::RenderResult one = render(scene, 16, 1), three = render(scene, 16, 3);
  int different = 0;
  for (int y = 0; y < scene.height; ++y) {
    for (int x = 0; x < scene.width; ++x)
      different += one.film.mean(x, y, 0) != three.film.mean(x, y, 0) ? 1 : 0;
  }
  return {32,
          "pixels that differ, 1 and 3 threads",
          "differ between ISAs",
          fmt::format("{} of 256", different),
          "0 on one machine",
          different == 0};
}

}  // namespace

std::vector<HardCase> path_cases() {
  return {depth_cap(), long_paths(), same_bits()};
}

}  // namespace hard_cases
