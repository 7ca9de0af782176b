// carlo_bench_lambert SCENE SEED: the renderer built with only what a diffuse scene of
// parallelograms needs. `./carlo bench` starts it in turns with the whole renderer
// (lean_build.cpp).

#include "course/cli/main_guard.h"
#include "render_cost.h"
#include "renderer/lanes/lane_integrator.h"
#include "renderer/lanes/lane_scene.h"
#include "scene/needs.h"
#include "support/error.h"

#include <cstdlib>

namespace {

int run(int argc, char** argv) {
  if (argc != 3) throw carlo::Error("expected SCENE SEED, got {} arguments", argc - 1);
  const carlo::Scene scene = bench::load_cost_scene(argv[1]);
  if (!renderer::LaneScene::suits(carlo::needs(scene), scene)) {
    throw carlo::Error("{} is no scene for the vector kernel", argv[1]);
  }
  const renderer::LaneScene lanes(scene);
  if (lanes.phong || lanes.close()) {
    throw carlo::Error("{} needs more than diffuse parallelograms that keep apart", argv[1]);
  }
  const auto integrator =
      renderer::make_lane_integrator(scene, std::strtoull(argv[2], nullptr, 10), {});
  bench::print_render_cost(*integrator, scene);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  return carlo::run_main([&] { return run(argc, argv); });
}
