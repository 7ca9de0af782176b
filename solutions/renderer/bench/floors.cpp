#include "context.h"
#include "render/scene_film.h"
#include "renderer/path_integrator.h"
#include "scene/load_scene.h"

#include <fmt/core.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

// How far the time of a path is from that of its rays' intersections alone.

namespace bench {
namespace {

using carlo::Scene;

struct Floored {
  std::string name;
  Scene scene;
  std::vector<double> whole = {}, first = {};  ///< seconds a path: as it is, and its first segment
  double rays = 0;                             ///< of a path
};

/// All scenes with a reference image, on small films.
std::vector<Floored> all_scenes(const Options& options) {
  std::vector<Floored> cases;
  for (const std::string& name : reference_scenes(options)) {
    Scene scene = carlo::load_scene(options.scenes / (name + ".xml"));
    carlo::resize(scene, 128, 128);
    scene.sampler = carlo::SamplerKind::sobol;
    cases.push_back({name, std::move(scene)});
  }
  return cases;
}

Rendered render_one(const Scene& scene, std::uint64_t seed, std::uint32_t samples) {
  const auto integrator =
      renderer::make_path_integrator(scene, {.seed = seed,
                                             .spp = samples,
                                             .technique = renderer::Technique::automatic,
                                             .guidance = renderer::Guidance::automatic});
  return render_timed(*integrator, scene, samples);
}

/// The time of a path that meets nothing.
double time_of_nothing(const Scene& any, std::uint64_t seed, std::uint32_t samples) {
  Scene empty;
  empty.width = any.width, empty.height = any.height, empty.camera = any.camera;
  empty.sampler = any.sampler, empty.max_depth = 1;
  empty.lights.environment = carlo::Rgb(1);
  const Rendered rendered = render_one(empty, seed, samples);
  return rendered.seconds / rendered.paths;
}

}  // namespace

void bench_floors(Context& context) {
  context.begin("How far from the floor");
  context.page().prose(
      "A path's rays, each at the price of the cheapest that the scene has: a camera ray that ends "
      "at its first surface, less what such a path costs that meets nothing. Rays from surfaces "
      "are scattered, and take more. Shading, the choice of lights and sums come on top.");
  const std::uint32_t samples = context.options().full ? 256 : 64;
  const int runs = context.options().full ? 7 : 3;
  std::vector<Floored> cases = all_scenes(context.options());
  std::vector<double> nothing;
  double done = 0;
  for (int run = 0; run < runs; ++run) {
    const std::uint64_t seed = context.options().seed + static_cast<std::uint64_t>(run);
    nothing.push_back(time_of_nothing(cases.front().scene, seed, samples));
    for (Floored& c : cases) {
      const Rendered whole = render_one(c.scene, seed, samples);
      Scene first = c.scene;
      first.max_depth = 1;
      const Rendered ends = render_one(first, seed, samples);
      c.whole.push_back(whole.seconds / whole.paths), c.rays = whole.rays / whole.paths;
      c.first.push_back(ends.seconds / ends.paths);
      context.progress(++done / (runs * static_cast<double>(cases.size())));
    }
  }
  carlo::Table table(
      {"scene", "time a path [range]", "rays a path", "one ray", "its floor", "x the floor"},
      {"scene", "seconds_a_path", "rays", "seconds_a_ray", "floor", "ratio"});
  for (const Floored& c : cases) {
    const double ray = median(c.first) - median(nothing), floor = c.rays * ray;
    const Spread whole = spread(c.whole);
    if (!(ray > 0)) {  // what pixels see is known without rays (lanes/straight-inl.h)
      table.add_row(
          {c.name, seconds_spread_cell(whole), carlo::number_cell(c.rays), "none", "none", "none"});
      continue;
    }
    table.add_row({c.name, seconds_spread_cell(whole), carlo::number_cell(c.rays),
                   carlo::seconds_cell(ray), carlo::seconds_cell(floor),
                   carlo::number_cell(whole.median / floor)});
  }
  context.table("floors", table,
                fmt::format("128 x 128 pixels, {} samples, one thread; medians of {} runs; a path "
                            "that meets nothing takes {}",
                            samples, runs, carlo::seconds_cell(median(nothing)).text));
}

}  // namespace bench
