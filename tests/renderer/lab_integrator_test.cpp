// Tests lab 8's solution as an integrator, as used by `./carlo render --mine`, against the
// reference renderer, and what it refuses.

#include "scene_renderer/lab_integrator.h"

#include "lab_scenes.h"
#include "scene_tools.h"
#include "support/error.h"

#include <catch2/catch_test_macros.hpp>

#include <cmath>
#include <string>
#include <variant>
#include <vector>

namespace {

using namespace scene_tools;
using lab08::Method;

constexpr std::uint32_t spp = 256;

Scene small_box(SamplerKind sampler) {
  Scene scene = lab_scenes::load("cornell_lambert");
  resize(scene, 24, 24);
  scene.sampler = sampler;
  return scene;
}

RenderResult render_lab(const Scene& scene, Method method, std::uint64_t seed, int threads = 0) {
  const auto integrator = lab08::make_lab_integrator(scene, {method, seed, spp});
  return render(*integrator, scene.width, scene.height,
                {.spp = spp, .threads = threads, .progress = false});
}

/// |z| <= 4 for the image's mean in each channel: a false alarm for 6.3e-5 of the seeds per
/// channel, 1e-3 for the whole file. With standard errors of at most 1 %, a bias of 7 % is detected
/// with probability .999; agreement_test.cpp tests more closely.
void check_means(const RenderResult& a, const RenderResult& b) {
  const MeanRadiance x = mean_radiance(a.film), y = mean_radiance(b.film);
  CHECK(a.counts.bad == 0);
  for (std::size_t c = 0; c < 3; ++c) {
    const double error = std::hypot(x.standard_error[c], y.standard_error[c]);
    INFO("channel " << c << ": " << x.value[c] << " for " << y.value[c] << " +- " << error);
    CHECK(std::abs(x.value[c] - y.value[c]) <= 4 * error);
    CHECK(x.standard_error[c] <= .02 * x.value[c]);
  }
}

}  // namespace

TEST_CASE("Lab 08's tracers give the Cornell box the reference renderer's mean") {
  const RenderResult reference = render_scene(small_box(SamplerKind::independent), spp, 1);
  for (const Method method : {Method::iterative, Method::recursive, Method::direct}) {
    check_means(render_lab(small_box(SamplerKind::independent), method, 2), reference);
  }
  for (const SamplerKind sampler : {SamplerKind::stratified, SamplerKind::sobol}) {
    // Their standard errors are upper bounds.
    check_means(render_lab(small_box(sampler), Method::iterative, 3), reference);
  }
}

TEST_CASE("Lab 08 honours the scene's longest path") {
  Scene scene = small_box(SamplerKind::independent);
  for (const int depth : {1, 2, 3}) {
    scene.max_depth = depth;
    check_means(render_lab(scene, Method::iterative, 4), render_scene(scene, spp, 5));
  }
}

TEST_CASE("Lab 08's images have the same bits for any number of threads, others for other seeds") {
  const Scene scene = small_box(SamplerKind::sobol);
  for (const Method method : {Method::iterative, Method::recursive, Method::direct}) {
    const auto pixels = [&](std::uint64_t seed, int threads) {
      return render_lab(scene, method, seed, threads).film.mean().pixels;
    };
    const auto one = pixels(1, 1);
    CHECK(pixels(1, 3) == one);
    CHECK(pixels(2, 1) != one);
  }
}

TEST_CASE("Lab 08 refuses what its tracers would get wrong") {
  Scene scene = small_box(SamplerKind::sobol);
  scene.max_depth = 3;
  CHECK_THROWS_AS(lab08::make_lab_integrator(scene, {Method::recursive}), Error);
  CHECK_THROWS_AS(lab08::make_lab_integrator(scene, {Method::direct}), Error);
  CHECK_NOTHROW(lab08::make_lab_integrator(scene, {Method::iterative}));
  CHECK_THROWS_AS(lab08::make_lab_integrator(lab_scenes::load("caustics"), {Method::recursive}),
                  Error);
  Scene other = scene;
  scene.lights.points.push_back({Vec3(0), Rgb(1)});
  CHECK_THROWS_AS(lab08::make_lab_integrator(scene, {Method::iterative}), Error);
  other.lights.envmap = Envmap{Image(2, 1)};
  CHECK_THROWS_AS(lab08::make_lab_integrator(other, {Method::iterative}), Error);
}

TEST_CASE("Lab 08 shades a mesh by its triangles, whatever its vertex normals, and says so") {
  // An open sheet whose vertex normals are tilted, under a constant sky: the albedo.
  Scene scene;
  scene.width = scene.height = 4;
  scene.sampler = SamplerKind::independent;
  scene.camera = look_at({0, 0, 3}, {0, 0, 0}, {0, 1, 0}, 1);
  scene.lights.environment = Rgb(1);
  scene.materials = {{Diffuse{Rgb(0.8f)}, true}};
  Mesh mesh{{{-1, -1, 0}, {1, -1, 0}, {0, 1, 0}}, {{0, 1, 2}}};
  for (const auto& normals : {std::vector<Vec3>{}, {glm::normalize(Vec3(1, 0, 1))}}) {
    mesh.normals = normals;
    if (!normals.empty()) mesh.normals_of = {{0, 0, 0}};
    scene.shapes = {{mesh}};
    const MeanRadiance mean = mean_radiance(render_lab(scene, Method::iterative, 4).film);
    CHECK(std::abs(mean.value[0] - 0.8) <= 4 * mean.standard_error[0]);
    const std::string name = lab08::make_lab_integrator(scene, {Method::iterative, 4, spp})->name();
    CHECK((name.find("without vertex normals") != std::string::npos) == !normals.empty());
  }
}
