// Adaptive renders by both kernels are unbiased, and have the same bits for any number of threads.

#include "lab_scenes.h"
#include "renderer/production/adaptive.h"
#include "scene/load_scene.h"
#include "scene/sampler_kind.h"
#include "scene_tools.h"

#include <catch2/catch_test_macros.hpp>

#include <cmath>
#include <string>

namespace {

using namespace scene_tools;

AdaptiveResult render_adaptive(const Scene& scene, renderer::Kernel kernel, double target,
                               std::uint64_t seed, int threads) {
  const auto integrator = renderer::make_path_integrator(
      scene, {.seed = seed, .spp = adaptive_strata, .kernel = kernel});
  return render_adaptively(*integrator, scene.width, scene.height, {target, 4096, {}},
                           {.threads = threads, .progress = false});
}

/// A closed cube that glows all around and reflects half: every pixel is 2, and only the lengths of
/// paths vary.
Scene furnace(SamplerKind sampler) {
  Scene scene;
  scene.width = scene.height = 8;
  scene.sampler = sampler;
  scene.camera = look_at({.1f, .2f, .3f}, {1, 1, 1}, {0, 1, 0}, 100);
  scene.materials = {{Diffuse{Rgb(.5f)}, false}};
  const Vec3 x(2, 0, 0), y(0, 2, 0), z(0, 0, 2), low(-1), high(1);
  for (const Parallelogram& face :
       {Parallelogram{low, x, y}, Parallelogram{low, y, z}, Parallelogram{low, z, x},
        Parallelogram{high, -y, -x}, Parallelogram{high, -z, -y}, Parallelogram{high, -x, -z}})
    scene.shapes.push_back({face, 0, Rgb(1)});
  return scene;
}

TEST_CASE("Adaptive renders of a furnace are unbiased, by both kernels and all samplers") {
  // 60 renders per case; z of their mean, with the standard error from their spread, is Student's t
  // with 59 degrees: |z| > 5 fails one in 10^5 cases by chance. Each would show a bias of .5 %.
  for (const renderer::Kernel kernel : {renderer::Kernel::scalar, renderer::Kernel::best}) {
    for (const SamplerKind sampler : sampler_kinds) {
      const Scene scene = furnace(sampler);
      double sum = 0, squares = 0;
      for (std::uint64_t seed = 1; seed <= 60; ++seed) {
        const RenderResult result = render_adaptive(scene, kernel, 0.04, seed, 1);
        const double error = mean_radiance(result.film).value[0] - 2;
        sum += error;
        squares += error * error;
      }
      const double deviation = std::sqrt((squares - sum * sum / 60) / 59);
      INFO("sampler " << static_cast<int>(sampler) << ": mean error " << sum / 60 << " +- "
                      << deviation / std::sqrt(60.0));
      CHECK(std::abs(sum) <= 5 * deviation * std::sqrt(60.0) + 60 * 1e-5);
      CHECK(deviation / std::sqrt(60.0) <= 0.002);
    }
  }
}

TEST_CASE("An adaptive render has the same bits for 1, 2 and 3 threads, by both kernels") {
  for (const char* name : {"partial_occluders", "cornell_phong"}) {
    Scene scene = lab_scenes::load(name);
    resize(scene, 22, 18);
    const AdaptiveResult one = render_adaptive(scene, renderer::Kernel::best, 0.3, 5, 1);
    CHECK(one.summary.most > one.summary.least);
    for (const int threads : {2, 3}) {
      const RenderResult many = render_adaptive(scene, renderer::Kernel::best, 0.3, 5, threads);
      CHECK(many.film.mean().pixels == one.film.mean().pixels);
      CHECK(many.film.standard_error().pixels == one.film.standard_error().pixels);
      CHECK(many.counts.rays == one.counts.rays);
    }
  }
}

}  // namespace
