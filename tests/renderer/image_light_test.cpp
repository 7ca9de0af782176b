// Images around the scene as lights, in whole renders against closed forms (4 standard errors, as
// in closed_form_scenes_test.cpp), by both kernels and with light paths; and the gain from
// importance sampling under a small sun.

#include "closed_forms.h"
#include "image/exr.h"
#include "lab_scenes.h"
#include "random/rng.h"
#include "renderer/lights.h"
#include "renderer/warp.h"
#include "scene_tools.h"
#include "sky.h"

#include <catch2/catch_test_macros.hpp>
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

namespace {

using namespace scene_tools;
using renderer::Kernel;
using renderer::Technique;

struct Way {
  const char* name;
  Kernel kernel;
  Technique technique;
};

std::vector<Way> ways(const Scene& scene) {
  std::vector<Way> ways{{"scalar", Kernel::scalar, Technique::path}};
  if (renderer::light_paths_suit(scene)) {
    ways.push_back({"vector", Kernel::best, Technique::path});
    ways.push_back({"light paths", Kernel::best, Technique::bidirectional});
  }
  return ways;
}

MeanRadiance mean_of(const Scene& scene, const Way& way, std::uint32_t spp) {
  const auto integrator = renderer::make_path_integrator(
      scene, {.seed = 3, .spp = spp, .kernel = way.kernel, .technique = way.technique});
  const RenderResult result =
      render(*integrator, scene.width, scene.height, {.spp = spp, .threads = 0, .progress = false});
  CHECK(result.counts.bad == 0);
  return mean_radiance(result.film);
}

void check_means(const Scene& scene, double exact, std::uint32_t spp) {
  for (const Way& way : ways(scene)) {
    const MeanRadiance mean = mean_of(scene, way, spp);
    for (std::size_t c = 0; c < 3; ++c) {
      INFO(way.name << ", channel " << c << ": " << mean.value[c] << " +- "
                    << mean.standard_error[c] << " for " << exact);
      CHECK(std::abs(mean.value[c] - exact) <= 4 * mean.standard_error[c] + 2e-6 * exact);
      CHECK(mean.standard_error[c] <= .003 * exact);
    }
  }
}

/// The scene's directions of the image's x, y and z, as columns.
glm::dmat3 turned() {
  const glm::dvec3 x = glm::normalize(glm::dvec3(1, -2, 2)),
                   y = glm::normalize(glm::cross(x, glm::dvec3(3, 1, 1)));
  return {x, y, glm::cross(x, y)};
}

/// A diffuse floor with normal n, seen in one small spot at the origin, under an image of constant
/// radiance; the camera is close to it, above.
Scene floor_under_image(Vec3 n, int height, Rgb radiance) {
  Scene scene;
  scene.width = scene.height = 8;
  scene.sampler = SamplerKind::independent;
  scene.materials = {{Diffuse{Rgb(.7f)}, false}};
  const Vec3 u = glm::normalize(glm::cross(n, Vec3(.3f, .4f, .5f))), v = glm::cross(n, u);
  scene.shapes = {{Parallelogram{-u - v, 2.0f * u, 2.0f * v}}};
  scene.camera = look_at(n + .5f * u, Vec3(0), v, .01);
  Envmap map{Image(2 * height, height)};
  std::fill(map.image.pixels.begin(), map.image.pixels.end(), radiance);
  scene.lights.envmap = map;
  return scene;
}

TEST_CASE("A uniform image is a constant environment") {
  // Phong balls that see each other, on a floor, and a light that is chosen as often as the image.
  Scene scene = floor_under_image({0, 0, 1}, 8, Rgb(.5f, 1, 2));
  scene.materials.push_back({Phong{Rgb(.3f), Rgb(.6f), 30}, false});
  scene.shapes.push_back({Sphere{{-.3f, 0, .3f}, .3f}, 1});
  scene.shapes.push_back({Sphere{{.4f, .1f, .3f}, .3f}, 1});
  scene.shapes.push_back({Sphere{{0, .4f, 1.2f}, .25f}, 0, Rgb(60)});
  scene.camera = look_at({.3f, -3, 1}, {0, 0, .3f}, {0, 0, 1}, 40);
  scene.width = scene.height = 24;
  Scene constant = scene;
  constant.lights.envmap.reset();
  constant.lights.environment = Rgb(.5f, 1, 2);
  const MeanRadiance right = mean_of(constant, {"", Kernel::scalar, Technique::path}, 4096);
  for (const Way& way : ways(scene)) {
    const MeanRadiance mean = mean_of(scene, way, 2048);
    for (std::size_t c = 0; c < 3; ++c) {
      const double error = std::hypot(mean.standard_error[c], right.standard_error[c]);
      INFO(way.name << ": " << mean.value[c] << " for " << right.value[c] << " +- " << error);
      CHECK(std::abs(mean.value[c] - right.value[c]) <= 4 * error);
      CHECK(error <= .002 * right.value[c]);
    }
  }
}

// A plane whose normal is `tilt` away from the pole of the bright half of the sky sees (1 + cos)/2
// of it: E = pi L (1 + cos(tilt)) / 2. (The formula of the tilted plane under an isotropic sky.)
TEST_CASE("Half a sky gives a tilted floor pi L (1 + cos) / 2") {
  for (const double tilt : {0., 1., closed_forms::pi / 2, 2.5}) {
    for (const bool turn : {false, true}) {
      const glm::dmat3 rotation = turn ? turned() : glm::dmat3(1);
      const glm::dvec3 n =
          rotation * glm::dvec3(std::sin(tilt) * .6, std::cos(tilt), std::sin(tilt) * .8);
      Scene scene = floor_under_image(Vec3(n), 6, Rgb(2));
      Envmap& map = scene.lights.envmap.value();
      map.rotation = rotation;
      for (std::size_t i = 6 * 6; i < map.image.pixels.size(); ++i)
        map.image.pixels[i] = Rgb(0);
      INFO("tilt " << tilt << (turn ? ", turned" : ""));
      check_means(scene, .7 * 2 * (1 + std::cos(tilt)) / 2, 16384);
    }
  }
}

// Integral of cos(theta) over the texel: its width times (sin^2 b - sin^2 a) / 2.
TEST_CASE("A sun of one texel gives a level floor what it must, from anywhere in the sky") {
  for (const int row : {0, 7, 15}) {
    Scene scene = floor_under_image({0, 1, 0}, 32, Rgb(0));
    Image& image = scene.lights.envmap.value().image;
    image.at(41, row) = Rgb(1000);
    const double step = closed_forms::pi / 32, a = std::sin(row * step),
                 b = std::sin((row + 1) * step);
    INFO("row " << row);
    check_means(scene, .7 * 1000 / closed_forms::pi * step * (b * b - a * a) / 2, 1024);
  }
}

TEST_CASE("A wall keeps the sun out, and a room without a window is dark") {
  Scene scene = floor_under_image({0, 1, 0}, 32, Rgb(0));
  scene.lights.envmap.value().image.at(41, 5) = Rgb(1000);
  scene.materials.push_back({Diffuse{Rgb(0)}, true});
  scene.shapes.push_back({Parallelogram{{-9, 2, -9}, {0, 0, 18}, {18, 0, 0}}, 1});
  for (const Way& way : ways(scene))
    CHECK(mean_of(scene, way, 64).value[0] == 0);
  // Six walls around everything, which no ray can leave.
  const Vec3 low(-2), x(4, 0, 0), y(0, 4, 0), z(0, 0, 4);
  scene.shapes.pop_back();
  for (const Parallelogram& wall : {Parallelogram{low, x, y},
                                    {low, y, z},
                                    {low, z, x},
                                    {low + z, x, y},
                                    {low + x, y, z},
                                    {low + y, z, x}})
    scene.shapes.push_back({wall, 1});
  for (const Way& way : ways(scene))
    CHECK(mean_of(scene, way, 64).value[0] == 0);
}

TEST_CASE("Rays that meet nothing show the image") {
  Scene scene;
  scene.width = scene.height = 1;
  Envmap map{Image(8, 4), turned()};
  for (std::size_t i = 0; i < map.image.pixels.size(); ++i)
    map.image.pixels[i] = Rgb(static_cast<float>(i));
  scene.lights.envmap = map;
  // Without anything else, and beside a shape.
  for (const bool beside : {false, true}) {
    for (int texel = 1; texel < 32; texel += 5) {
      const int column = texel % 8, row = texel / 8;
      const double phi = 2 * closed_forms::pi * (column + .5) / 8,
                   theta = closed_forms::pi * (row + .5) / 4;
      const Vec3 d(turned() * glm::dvec3(std::sin(theta) * std::sin(phi), std::cos(theta),
                                         -std::sin(theta) * std::cos(phi)));
      scene.camera = look_at(Vec3(0), d, glm::cross(d, Vec3(.1f, .2f, .9f)), 1);
      scene.materials = {{Diffuse{Rgb(.5f)}, true}};
      scene.shapes.clear();
      if (beside) scene.shapes = {{Sphere{-5.0f * d, 1}}};
      for (const Way& way : ways(scene))
        CHECK(mean_of(scene, way, 16).value[0] == texel);
    }
  }
}

struct Spread {
  double mean, relative_mse;  ///< per estimate of two directions
};

/// Light reflected by level ground, by two directions: either one drawn as the ground reflects and
/// one from the image, weighted by the power heuristic, or both as the ground reflects.
Spread reflected(const Scene& scene, bool by_image) {
  const renderer::Lights lights(scene);
  const renderer::ShadingPoint here{{}, {0, 1, 0}};
  Rng rng(7);
  const auto cosine_weighted = [&](bool competes) {
    const float x = rng.uniform_float();
    const Vec3 local = renderer::sample_cosine_hemisphere({x, rng.uniform_float()});
    const Vec3 wi(local.x, local.z, local.y);
    const renderer::EnvmapTable::Texel texel = lights.beyond(here, wi);
    const float ratio = texel.pdf / renderer::cosine_hemisphere_pdf(wi.y);
    const float weight = competes ? 1 / (1 + ratio * ratio) : 1;
    return static_cast<double>(.5f * weight * texel.radiance.g);
  };
  const auto image_weighted = [&] {
    const float u_light = rng.uniform_float();
    const float x = rng.uniform_float();
    const auto light = lights.sample(here, u_light, {x, rng.uniform_float()});
    const Vec3 wi = glm::normalize(light->p);
    if (!(wi.y > 0)) return 0.0;
    const float ratio = renderer::cosine_hemisphere_pdf(wi.y) / light->pdf;
    return static_cast<double>(.5f / pi_f * wi.y * light->radiance.g /
                               (light->pdf * (1 + ratio * ratio)));
  };
  constexpr int n = 4'000'000;
  double sum = 0, squares = 0;
  for (int i = 0; i < n; ++i) {
    const double value = by_image ? cosine_weighted(true) + image_weighted()
                                  : .5 * (cosine_weighted(false) + cosine_weighted(false));
    sum += value;
    squares += value * value;
  }
  const double mean = sum / n;
  return {mean, (squares / n - mean * mean) / (mean * mean)};
}

// At equal numbers of directions. One cosine-weighted direction in a few thousand meets the sun.
TEST_CASE("Under a small sun importance sampling has a 20th of the error of cosine sampling") {
  Scene scene = floor_under_image({0, 1, 0}, 2, Rgb(1));
  scene.lights.envmap = Envmap{sky::image()};
  const Spread cosine = reflected(scene, false), image = reflected(scene, true);
  fmt::print("relMSE of two directions: cosine {:.3g}, image {:.3g}: {:.0f} times\n",
             cosine.relative_mse, image.relative_mse, cosine.relative_mse / image.relative_mse);
  // The few that meet the sun determine the first to 3 %.
  CHECK(std::abs(cosine.mean / image.mean - 1) <= .1);
  CHECK(cosine.relative_mse / image.relative_mse >= 20);
}

TEST_CASE("The sky of image_light.xml is the one that its command makes") {
  const Image made = sky::image(), read = read_exr(lab_scenes::folder() / "parts/sky.exr").image;
  REQUIRE((read.width == made.width && read.height == made.height));
  for (std::size_t i = 0; i < made.pixels.size(); ++i) {
    for (int c = 0; c < 3; ++c)
      CHECK(std::abs(read.pixels[i][c] / made.pixels[i][c] - 1) <= 2e-3f);
  }
}

}  // namespace
