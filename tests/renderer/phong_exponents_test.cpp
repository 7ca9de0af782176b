// The sharpest Phong lobe allowed in scenes, by both kernels: in a uniform environment a lobe of
// exponent n has radiance (n + 2)/(n + 1) cos theta, to 1/n, if it is entirely above the horizon.

#include "scene/materials.h"
#include "scene_tools.h"

#include <catch2/catch_test_macros.hpp>

#include <cmath>

namespace {

using namespace scene_tools;

/// A large square whose normal makes the angle `theta` with the line of sight, rotated by `turn`
/// about it: not along any coordinate axis.
Scene tilted_square(double theta, double turn, float exponent) {
  Scene scene;
  scene.width = scene.height = 8;
  scene.sampler = SamplerKind::independent;
  scene.camera = look_at({0, 0, 5}, {0, 0, 0}, {0, 1, 0}, .5);
  scene.lights.environment = Rgb(1);
  scene.materials = {{Phong{Rgb(0), Rgb(1), exponent}, false}};
  const Vec3 n(std::sin(theta) * std::cos(turn), std::sin(theta) * std::sin(turn), std::cos(theta));
  const Vec3 u = glm::normalize(glm::cross(n, Vec3(.3f, 1, .2f))), v = glm::cross(n, u);
  scene.shapes = {{Parallelogram{-10.f * u - 10.f * v, 20.f * u, 20.f * v}}};
  return scene;
}

double mean(const Scene& scene, renderer::Kernel kernel) {
  const auto integrator =
      renderer::make_path_integrator(scene, {.seed = 1, .spp = 256, .kernel = kernel});
  const RenderResult result =
      render(*integrator, scene.width, scene.height, {.spp = 256, .threads = 0, .progress = false});
  CHECK(result.counts.bad == 0);
  return mean_radiance(result.film).value[0];
}

TEST_CASE("The sharpest Phong lobe shows a mirror's cosine in both kernels") {
  // Ten times as sharp as well: the sharpest exponent must keep its distance from the first that
  // goes wrong.
  for (const float exponent : {sharpest_exponent, 10 * sharpest_exponent}) {
    for (const double degrees : {0., 5., 20., 40., 60., 75.}) {
      for (const double turn : {.1, 1., 2.3, 4.}) {
        const double theta = degrees * 3.14159265358979 / 180;
        const Scene scene = tilted_square(theta, turn, exponent);
        INFO("exponent " << exponent << ", " << degrees << " degrees, turned by " << turn);
        for (const auto kernel : {renderer::Kernel::best, renderer::Kernel::scalar})
          CHECK(std::abs(mean(scene, kernel) / std::cos(theta) - 1) <= 1e-4);
      }
    }
  }
}

}  // namespace
