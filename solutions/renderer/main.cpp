// `./carlo render`: the reference renderer.

#include "cli/main_guard.h"
#include "render/render_app.h"
#include "renderer/path_integrator.h"

#include <CLI/CLI.hpp>

int main(int argc, char** argv) {
  return carlo::run_main([&] {
    return carlo::render_app(
        argc, argv,
        [](const carlo::Scene& scene, std::uint64_t seed, std::uint32_t spp) {
          return renderer::make_path_integrator(scene, {.seed = seed, .spp = spp});
        },
        [](CLI::App& app) { app.footer("./carlo render --mine ... renders by your own lab 08."); });
  });
}
