// `./carlo render` in a student's tree, and `./carlo render --mine`: scenes by lab 8's tracers.

#include "course/cli/arguments.h"
#include "course/cli/main_guard.h"
#include "course/render/render_app.h"
#include "scene_renderer/lab_integrator.h"

#include <cstdint>
#include <map>
#include <string>

namespace {

const std::map<std::string, lab08::Method> methods = {{"iterative", lab08::Method::iterative},
                                                      {"recursive", lab08::Method::recursive},
                                                      {"direct", lab08::Method::direct}};

}  // namespace

int main(int argc, char** argv) {
  return carlo::run_main([&] {
    std::string method = "iterative";
    return carlo::render_app(
        argc, argv,
        [&](const carlo::Scene& scene, std::uint64_t seed, std::uint32_t spp) {
          return lab08::make_lab_integrator(
              scene, {.method = methods.at(method), .seed = seed, .spp = spp});
        },
        [&](carlo::CommandLine& app) {
          app.option("--method", method,
                     "iterative (Lab 8.8), recursive (Lab 8.4: no mirrors, no glass) or direct "
                     "(Lab 8.7)")
              .one_of({"iterative", "recursive", "direct"})
              .show_default();
          app.footer("The image is your own lab 8's.");
        });
  });
}
