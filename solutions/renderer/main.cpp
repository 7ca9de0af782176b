// `./carlo render`: the reference renderer.

#include "cli/arguments.h"
#include "cli/main_guard.h"
#include "render/render_app.h"
#include "renderer/path_integrator.h"

#include <string>

int main(int argc, char** argv) {
  return carlo::run_main([&] {
    std::string kernel = "best";
    return carlo::render_app(
        argc, argv,
        [&](const carlo::Scene& scene, std::uint64_t seed, std::uint32_t spp) {
          const auto choice =
              kernel == "scalar" ? renderer::Kernel::scalar : renderer::Kernel::best;
          return renderer::make_path_integrator(scene,
                                                {.seed = seed, .spp = spp, .kernel = choice});
        },
        [&](carlo::CommandLine& app) {
          app.option("--kernel", kernel,
                     "best: what suits the scene; scalar: the one that renders all scenes")
              .one_of({"best", "scalar"})
              .show_default();
          app.footer("./carlo render --mine ... renders by your own lab 08.");
        });
  });
}
