// Paths of one segment, and blocks of samples rendered at once: the vector kernel has code of its
// own for both, with the same bits as without. And lights that pixels see directly, by rays of
// their own.

#include "lab_scenes.h"
#include "lane_records.h"
#include "lane_scenes.h"
#include "random/rng.h"
#include "renderer/lanes/lane_kernel.h"
#include "renderer/path_integrator.h"
#include "scene_tools.h"

#include <catch2/catch_test_macros.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace {

using namespace scene_tools;
using lane_scenes::add_box;

float uniform(Rng& rng, float low, float high) {
  return low + (high - low) * rng.uniform_float();
}

/// An orthonormal basis, its third axis at random.
std::array<Vec3, 3> random_axes(Rng& rng) {
  const Vec3 n = glm::normalize(
      Vec3(uniform(rng, -1, 1), uniform(rng, -1, 1), uniform(rng, -1, 1)) + Vec3(0, 0, 1e-3f));
  const Vec3 u = glm::normalize(glm::cross(n, std::abs(n.x) < .5f ? Vec3(1, 0, 0) : Vec3(0, 1, 0)));
  return {u, glm::cross(n, u), n};
}

struct Plane {
  Vec3 middle, along, n;
};

/// Adds parallelograms of one plane, of sizes from .03 to 2, some upon others and some facing the
/// other way, each of a radiance of its own, or all alike.
Plane add_plane(Scene& scene, Rng& rng, int count, float scale, Vec3 center, bool alike) {
  const auto [u, v, n] = random_axes(rng);
  const Vec3 middle = center + scale * uniform(rng, -1, 1) * n;
  for (int i = 0; i < count; ++i) {
    const float size = scale * std::pow(10.0f, uniform(rng, -1.5f, .3f));
    const float turn = uniform(rng, 0, 6.28f), angle = turn + uniform(rng, .3f, 2.8f);
    const Vec3 a = size * (std::cos(turn) * u + std::sin(turn) * v);
    const Vec3 b = size * uniform(rng, .02f, 1) * (std::cos(angle) * u + std::sin(angle) * v);
    const Vec3 corner = middle + scale * (uniform(rng, -1, 1) * u + uniform(rng, -1, 1) * v);
    const Rgb radiance =
        alike ? Rgb(.1f, .7f, 1.3f) : Rgb(static_cast<float>(scene.shapes.size() + 1));
    const bool turned = rng.uniform_float() < .5f;
    const Parallelogram shape = turned ? Parallelogram{corner, b, a} : Parallelogram{corner, a, b};
    scene.shapes.push_back({shape, 0, radiance});
  }
  return {middle, u, n};
}

/// Black lights: three planes of parallelograms, two spheres and a box; or, in half of the scenes,
/// planes alone, one or three, all of one radiance, so that whole pixels see nothing or the same. A
/// third of the cameras are far, a third amidst, and a third look along a plane, close above it.
Scene random_lights(std::uint64_t seed, float scale, Vec3 center, int max_depth) {
  Rng rng(seed);
  Scene scene;
  scene.materials = {{Diffuse{Rgb(0)}, true}};
  const bool alike = seed % 4 < 2, alone = seed % 8 == 0;
  Plane plane{};
  for (int i = 0; i < (alone ? 1 : 3); ++i)
    plane = add_plane(scene, rng, 1 + static_cast<int>(uniform(rng, 0, 24)), scale, center, alike);
  for (int i = 0; i < (alike ? 0 : 2); ++i) {
    const Vec3 at(uniform(rng, -1, 1), uniform(rng, -1, 1), uniform(rng, -1, 1));
    scene.shapes.push_back(
        {Sphere{center + scale * at, scale * uniform(rng, .02f, .1f)}, 0, Rgb(.5f)});
  }
  if (!alike)
    add_box(scene, center + scale * Vec3(.2f), scale * Vec3(.1f, 0, 0), scale * Vec3(0, .1f, 0),
            scale * Vec3(0, 0, .1f), 0);
  const Vec3 away(uniform(rng, -1, 1), uniform(rng, -1, 1), uniform(rng, -1, 1));
  if (seed % 3 == 0) {
    const float height = std::pow(10.0f, uniform(rng, -3.5f, -.5f));
    const Vec3 from = plane.middle - scale * plane.along + scale * height * plane.n;
    scene.camera = look_at(from, plane.middle, plane.n, 60);
  } else {
    const Vec3 from = center + scale * (seed % 3 == 1 ? .5f : 4) * glm::normalize(away);
    scene.camera = look_at(from, center, {.1f, .2f, 1}, 40);
  }
  scene.max_depth = max_depth;
  scene.sampler = SamplerKind::sobol;
  resize(scene, 37, 29);
  return scene;
}

/// The means of three blocks of five samples, at once or one by one.
std::vector<std::array<double, 3>> blocks_of(const Scene& scene, renderer::Kernel kernel,
                                             bool at_once) {
  const auto integrator = renderer::make_path_integrator(scene, {.seed = 4, .kernel = kernel});
  carlo::Tile tile{.x0 = 3, .y0 = 2, .x1 = 14, .y1 = 9, .first_sample = 10, .samples = 5};
  constexpr std::size_t pixels = 11 * 7;
  std::vector<std::array<double, 3>> means(3 * pixels);
  carlo::Counts counts;
  if (at_once) {
    integrator->render_blocks(tile, 3, means, counts);
  } else {
    std::vector<std::array<double, 3>> block(pixels);
    for (std::size_t b = 0; b < 3; ++b, tile.first_sample += tile.samples) {
      integrator->render(tile, block, counts);
      for (std::size_t i = 0; i < pixels; ++i)
        means[i * 3 + b] = block[i];
    }
  }
  CHECK(counts.paths == 3 * 5 * pixels);
  return means;
}

/// By one thread; lights that pixels see directly by other rays than paths or not.
carlo::RenderResult render_alone(const Scene& scene, std::uint32_t spp, bool lights_apart,
                                 std::uint64_t seed = 1) {
  const auto integrator = renderer::make_path_integrator(
      scene, {.seed = seed, .spp = spp, .choices = {.lights_apart = lights_apart}});
  return render(*integrator, scene.width, scene.height,
                {.spp = spp, .threads = 1, .progress = false});
}

/// Small black lights of radiance 1 anywhere around, behind a few of them a box.
Scene small_lights(std::uint64_t seed, float scale, Vec3 center) {
  Rng rng(seed);
  Scene scene;
  scene.materials = {{Diffuse{Rgb(0)}, true}};
  const auto anywhere = [&] {
    return Vec3(uniform(rng, -1, 1), uniform(rng, -1, 1), uniform(rng, -1, 1));
  };
  for (int i = 0; i < 12; ++i) {
    const auto [u, v, n] = random_axes(rng);
    const float size = scale * std::pow(10.0f, uniform(rng, -2.5f, -.6f));
    scene.shapes.push_back(
        {Parallelogram{center + scale * anywhere(), size * u, size * v}, 0, Rgb(1)});
  }
  add_box(scene, center - scale * Vec3(.2f), scale * Vec3(.1f, 0, 0), scale * Vec3(0, .1f, 0),
          scale * Vec3(0, 0, .1f), 0);
  const float distance = seed % 2 == 0 ? .3f : 3;
  scene.camera =
      look_at(center + scale * distance * glm::normalize(anywhere()), center, {.1f, .2f, 1}, 40);
  scene.max_depth = 2;
  scene.sampler = SamplerKind::sobol;
  resize(scene, 37, 29);
  return scene;
}

}  // namespace

// Where everything is black, a second segment adds nothing, but takes the code for all paths.
TEST_CASE("Paths of one segment have the bits of longer ones in the dark") {
  struct Place {
    float scale;
    Vec3 center;
  };
  const std::vector<Place> places = {{1, {0, 0, 0}},
                                     {1e-4f, {0, 0, 0}},
                                     {1e6f, {0, 0, 0}},
                                     {1, {30, -50, 20}},
                                     {1, {3e3f, 2e3f, -1e3f}}};
  int lit = 0;
  std::uint64_t paths = 0, rays = 0;
  instruction_sets::on_all([&] {
    for (std::uint64_t seed = 1; seed <= 160; ++seed) {
      const Place& place = places[seed % places.size()];
      const std::uint32_t spp = std::array{1u, 8u, 24u, 64u}[seed / 5 % 4];
      INFO("seed " << seed << ", spp " << spp << ", scale " << place.scale);
      const auto render = [&](int max_depth) {
        return render_alone(random_lights(seed, place.scale, place.center, max_depth), spp, false);
      };
      const carlo::RenderResult straight = render(1);
      const Image image = straight.film.mean();
      CHECK(image.pixels == render(2).film.mean().pixels);
      for (const Rgb& pixel : image.pixels)
        lit += pixel.x > 0;
      paths += straight.counts.paths, rays += straight.counts.rays;
    }
  });
  CHECK(lit > 20000);  // of 171680 for each instruction set
  INFO(rays << " rays for " << paths << " paths");
  CHECK(20 * rays < 19 * paths);  // the others are known without one
}

// In the dark, where there is nothing else to see. The cameras are amidst the lights or outside.
TEST_CASE("Rays that look for lights miss none that paths see") {
  struct Place {
    float scale;
    Vec3 center;
  };
  const std::vector<Place> places = {
      {1, {0, 0, 0}}, {1e-4f, {0, 0, 0}}, {1e6f, {0, 0, 0}}, {1, {300, -500, 200}}};
  constexpr std::uint32_t spp = 64;
  int apart = 0, lit = 0;
  double difference = 0, variance = 0;
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    const Place& place = places[seed / 2 % places.size()];
    const Scene scene = small_lights(seed, place.scale, place.center);
    const renderer::LaneScene lanes(scene);
    if (renderer::seen_lights(lanes, scene.camera, scene.width, scene.height).empty()) continue;
    ++apart;
    INFO("seed " << seed);
    const Image a = render_alone(scene, spp, true).film.mean(),
                b = render_alone(scene, spp, false).film.mean();
    for (std::size_t i = 0; i < a.pixels.size(); ++i) {
      const double by_rays = a.pixels[i].x, by_paths = b.pixels[i].x;
      lit += by_paths > 0;
      // One that was left out would have none; four samples in 64 have none of 256 once in 10^7.
      CHECK((by_rays > 0 || by_paths < 4.0 / spp));
      difference += by_rays - by_paths;
      variance += by_paths * (1 - by_paths) / spp * 1.25;
    }
  }
  CHECK(apart > 100);
  CHECK(lit > 800);
  INFO("difference " << difference << ", standard error " << std::sqrt(variance));
  CHECK(std::abs(difference) < 4 * std::sqrt(variance));  // alpha < 1e-4; Sobol' points have less
}

TEST_CASE("Rays that look for lights reduce the noise at their edges") {
  Scene scene = lab_scenes::load("many_lights");
  resize(scene, 128, 128);
  const auto relative_variance = [&](bool apart) {
    constexpr std::size_t seeds = 4;
    std::vector<double> sum(128 * 128), squares(128 * 128);
    for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
      const Image image = render_alone(scene, 64, apart, seed).film.mean();
      for (std::size_t i = 0; i < sum.size(); ++i) {
        const double y = image.pixels[i].y;
        sum[i] += y, squares[i] += y * y;
      }
    }
    double all = 0;
    for (std::size_t i = 0; i < sum.size(); ++i) {
      const double mean = sum[i] / seeds;
      all += (squares[i] / seeds - mean * mean) / (mean * mean + .01);
    }
    return all;
  };
  const double with = relative_variance(true), without = relative_variance(false);
  INFO(with << " and " << without);
  CHECK(with < .8 * without);
}

TEST_CASE("No light is too rarely sampled where pixels alone find them") {
  for (const renderer::Kernel kernel : {renderer::Kernel::best, renderer::Kernel::scalar}) {
    Scene scene = lab_scenes::load("many_lights");
    const auto least = [&] {
      return renderer::make_path_integrator(scene, {.kernel = kernel})->least_light_probability();
    };
    CHECK(least() < .01);
    scene.max_depth = 1;
    CHECK(least() == 1);
  }
}

TEST_CASE("Blocks of samples are the same whether rendered at once or not") {
  instruction_sets::on_all([] {
    for (const int max_depth : {1, 3}) {
      Scene scene = random_lights(1, 1, {0, 0, 0}, max_depth);
      scene.materials[0] = {Diffuse{Rgb(.6f)}, true};
      for (const renderer::Kernel kernel : {renderer::Kernel::best, renderer::Kernel::scalar})
        CHECK(blocks_of(scene, kernel, true) == blocks_of(scene, kernel, false));
    }
  });
}
