#include "render_cost.h"

#include "course/report/stopwatch.h"
#include "random/hash.h"
#include "render/driver.h"
#include "render/render_app.h"
#include "scene/load_scene.h"

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include <bit>

namespace bench {
namespace {

carlo::RenderResult render_once(const carlo::Integrator& integrator, const carlo::Scene& scene,
                                std::uint32_t samples) {
  return carlo::render(integrator, scene.width, scene.height,
                       {.spp = samples, .threads = 1, .progress = false});
}

std::uint64_t hash_of(const carlo::Image& image) {
  std::uint64_t result = 0;
  for (const auto& pixel : image.pixels) {
    for (const float value : {pixel.x, pixel.y, pixel.z})
      result = carlo::hash(result, std::bit_cast<std::uint32_t>(value));
  }
  return result;
}

}  // namespace

carlo::Scene load_cost_scene(const std::filesystem::path& path) {
  carlo::Scene scene = carlo::load_scene(path);
  carlo::resize(scene, cost_size, cost_size);
  scene.sampler = carlo::SamplerKind::sobol;
  return scene;
}

void print_render_cost(const carlo::Integrator& integrator, const carlo::Scene& scene) {
  (void)render_once(integrator, scene, cost_samples / 8);
  const carlo::Stopwatch stopwatch;
  const carlo::RenderResult result = render_once(integrator, scene, cost_samples);
  const double seconds = stopwatch.seconds();
  const nlohmann::json cost = {
      {"seconds_a_path", seconds / static_cast<double>(result.counts.paths)},
      {"image", hash_of(result.film.mean())},
      {"kernel", integrator.name()}};
  fmt::print("{}\n", cost.dump());
}

}  // namespace bench
