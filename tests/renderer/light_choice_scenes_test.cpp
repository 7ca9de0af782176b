// Scenes in which choosing lights by power alone would never choose a light, with a standard error
// of 0: a light of small power beside a strong one, and a light in a scene that a stray vertex
// makes large. Varied by ratio and order, moved and scaled, with each kernel, sampler and
// technique.
//
// Error rates: 5 standard errors, 6e-7 each if values are normal, in about 400 renders. Power: no
// standard error may be above 2 % of the expected value, and the light contributes half of it or
// more.

#include "closed_forms.h"
#include "scene_tools.h"

#include <catch2/catch_test_macros.hpp>
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace {

using namespace scene_tools;
using closed_forms::pi;
using renderer::Kernel;
using renderer::Technique;

struct Way {
  Kernel kernel;
  Technique technique;
  SamplerKind sampler;
};

std::string name_of(const Way& way) {
  return fmt::format("{}, {}, {}", way.kernel == Kernel::scalar ? "scalar" : "vector",
                     way.technique == Technique::path ? "path" : "bidirectional",
                     carlo::name_of(way.sampler));
}

/// The vector kernel does not support stratified samples; the scalar one does not support light
/// paths.
std::vector<Way> all_ways() {
  std::vector<Way> ways;
  for (const SamplerKind sampler : sampler_kinds) {
    ways.push_back({Kernel::scalar, Technique::path, sampler});
    if (sampler == SamplerKind::stratified) continue;
    ways.push_back({Kernel::best, Technique::path, sampler});
    ways.push_back({Kernel::best, Technique::bidirectional, sampler});
  }
  return ways;
}

void check(Scene scene, double exact, const std::string& name, std::uint32_t spp,
           double rounding = 2e-4) {
  for (const Way& way : all_ways()) {
    scene.sampler = way.sampler;
    const auto integrator = renderer::make_path_integrator(
        scene, {.seed = 5, .spp = spp, .kernel = way.kernel, .technique = way.technique});
    const RenderResult result = render(*integrator, scene.width, scene.height,
                                       {.spp = spp, .threads = 0, .progress = false});
    const MeanRadiance mean = mean_radiance(result.film);
    INFO(name << " by " << name_of(way) << ": " << mean.value[0] << " +- " << mean.standard_error[0]
              << " for " << exact);
    CHECK(result.counts.bad == 0);
    CHECK(std::abs(mean.value[0] - exact) <= 5 * mean.standard_error[0] + rounding * exact);
    CHECK(mean.standard_error[0] <= .02 * exact);
  }
}

/// A floor of albedo .5 and half side 3 about the origin, of which a spot is seen.
Scene floor_scene() {
  Scene scene;
  scene.width = scene.height = 4;
  scene.max_depth = 2;
  scene.materials = {{Diffuse{Rgb(.5f)}, false}};
  scene.shapes = {{Parallelogram{{-3, 0, -3}, {0, 0, 6}, {6, 0, 0}}}};
  scene.camera = look_at({.5f, .5f, .001f}, {0, 0, 0}, {0, 1, 0}, .1);
  return scene;
}

/// x -> scale (x + shift); intensities go with scale^2, so that radiances stay.
Scene moved(Scene scene, Vec3 shift, float scale) {
  const auto move = [&](Vec3& x) { x = scale * (x + shift); };
  for (Shape& shape : scene.shapes) {
    if (auto* quad = std::get_if<Parallelogram>(&shape.geometry)) {
      move(quad->origin);
      quad->u *= scale, quad->v *= scale;
    }
    if (auto* mesh = std::get_if<Mesh>(&shape.geometry)) {
      for (Vec3& x : mesh->positions)
        move(x);
    }
  }
  for (PointLight& light : scene.lights.points) {
    move(light.position);
    light.intensity *= scale * scale;
  }
  move(scene.camera.origin);
  return scene;
}

struct Where {
  const char* name;
  Vec3 shift;
  float scale;
};
const Where wheres[] = {{"in place", Vec3(0), 1},
                        {"moved", {4, -3, 5}, 1},
                        {"small", {.5f, .25f, -1}, 1e-3f},
                        {"large", Vec3(0), 1e3f}};

TEST_CASE("A light is seen beside a sun of up to 1e12 times its power") {
  // A sun of E = 3 at height h, a light of E = 3 at height 1: rho / pi (3 + 3).
  for (const float height : {1.0f, 1e2f, 1e4f, 1e6f}) {
    for (const bool swapped : {false, true}) {
      for (const Where& where : wheres) {
        Scene scene = floor_scene();
        scene.lights.points = {{{0, height, 0}, Rgb(3 * height * height)}, {{0, 1, 0}, Rgb(3)}};
        if (swapped) std::swap(scene.lights.points[0], scene.lights.points[1]);
        check(moved(std::move(scene), where.shift, where.scale), .5 / pi * 6,
              fmt::format("sun at {:g}, {}, {}", height, swapped ? "swapped" : "in order",
                          where.name),
              1024);
      }
    }
  }
}

TEST_CASE("Many lights are seen beside a sun") {
  for (const int lights : {3, 30, 200}) {
    Scene scene = floor_scene();
    const auto each = static_cast<float>(3.0 / lights);
    for (int i = 0; i < lights; ++i)
      scene.lights.points.push_back({{0, 1 + .001f * static_cast<float>(i), 0}, Rgb(each)});
    scene.lights.points.push_back({{0, 1e4f, 0}, Rgb(3e8f)});
    double sum = 3;
    for (int i = 0; i < lights; ++i)
      sum += static_cast<double>(each) / std::pow(1 + .001 * i, 2);
    check(std::move(scene), .5 / pi * sum, fmt::format("{} lights", lights), 1024);
  }
}

/// A quad below the floor, with a vertex that no face uses, and a grey environment map.
Scene stray_scene(float stray, bool two_vertices) {
  Scene scene = floor_scene();
  Mesh mesh{{{-1, -1, -1}, {1, -1, -1}, {1, -1, 1}, {-1, -1, 1}}, {{3, 2, 1}, {3, 1, 0}}};
  if (stray > 0) mesh.positions.emplace_back(stray);
  if (two_vertices) mesh.positions.insert(mesh.positions.end(), Vec3(-stray, 0, stray));
  scene.shapes.push_back({std::move(mesh)});
  scene.lights.envmap = Envmap{Image(4, 2)};
  std::fill(scene.lights.envmap->image.pixels.begin(), scene.lights.envmap->image.pixels.end(),
            Rgb(1));
  return scene;
}

/// rho / pi (pi + I): the image's radiance is 1, and so is the light's height.
void check_strays(const std::vector<float>& strays, std::uint32_t spp) {
  for (const float stray : strays) {
    for (const float intensity : {10.0f, .1f}) {
      for (const Where& where : wheres) {
        Scene scene = stray_scene(stray, stray > 1e5f);
        scene.lights.points = {{{0, 1, 0}, Rgb(intensity)}};
        check(moved(std::move(scene), where.shift, where.scale),
              .5 + .5 / pi * static_cast<double>(intensity),
              fmt::format("stray {:g}, light {:g}, {}", stray, intensity, where.name), spp);
      }
    }
  }
}

TEST_CASE("A stray vertex does not put a light out") {
  check_strays({0, 1e2f, 1e5f, 1e9f, 1e15f}, 1024);
}

/// A film over the square [-1, 1]^2 of a floor, below a pane that bends nothing (both indices 1),
/// below a light of intensity 3 at height 3: no path from the camera finds the light. Above a black
/// ceiling is a light `ratio` times as strong, which lights nothing. Exact: albedo I omega / (4
/// pi), omega the square's solid angle from the light.
Scene pane_scene(double ratio, bool swapped) {
  const auto level = [](float half, float y) {
    return Parallelogram{{-half, y, -half}, {0, 0, 2 * half}, {2 * half, 0, 0}};
  };
  Scene scene;
  scene.width = scene.height = 4;
  scene.max_depth = 4;
  scene.materials = {{Diffuse{Rgb(.5f)}, false}, {Dielectric{1, 1}, true}, {Diffuse{Rgb(0)}, true}};
  scene.shapes = {{level(50, 0), 0}, {level(50, 2.5f), 1}, {level(50, 4), 2}};
  scene.lights.points = {{{0, 3, 0}, Rgb(3)}, {{0, 5, 0}, Rgb(static_cast<float>(3 * ratio))}};
  if (swapped) std::swap(scene.lights.points[0], scene.lights.points[1]);
  scene.camera = look_at({0, 2, 0}, {0, 0, 0}, {0, 0, 1}, 2 * 180 / pi * std::atan(.5));
  return scene;
}

void check_pane(double ratio) {
  const double exact = .5 * 3 * std::atan2(1, 3 * std::sqrt(11.0)) / pi;
  for (const bool swapped : {false, true}) {
    Scene scene = pane_scene(ratio, swapped);
    for (const SamplerKind sampler : {SamplerKind::independent, SamplerKind::sobol}) {
      scene.sampler = sampler;
      constexpr std::uint32_t spp = 1 << 18;
      const auto integrator = renderer::make_path_integrator(
          scene, {.seed = 7, .spp = spp, .technique = Technique::bidirectional});
      const MeanRadiance mean = mean_radiance(
          render(*integrator, 4, 4, {.spp = spp, .threads = 0, .progress = false}).film);
      INFO("ratio " << ratio << ": " << mean.value[0] << " +- " << mean.standard_error[0] << " for "
                    << exact);
      CHECK(std::abs(mean.value[0] - exact) <= 5 * mean.standard_error[0] + 1e-4 * exact);
      CHECK(mean.standard_error[0] <= .03 * exact);
    }
  }
}

TEST_CASE("Paths from a weak light pass a pane, whatever light is stronger") {
  for (const double ratio : {1.0, 1e3, 1e6, 1e9})
    check_pane(ratio);
}

// Splats are whole multiples of a unit that depends on the brightest light: those of a weak one may
// be less than one.
TEST_CASE("Splats of a weak light are not lost beside 1e13 times as strong a light") {
  for (const double ratio : {1e12, 1e13})
    check_pane(ratio);
}

// The square of twice the scene's diameter does not fit into a float.
TEST_CASE("A stray vertex 1e19 away does not dim the environment map") {
  check_strays({1e18f, 1e19f, 1e30f}, 1 << 12);
}

// From outside a ball that emits inwards is black: its near half hides the far one.
TEST_CASE("A ball that shines inwards keeps its light in") {
  for (const float radiance : {1.0f, 1e4f, 1e8f}) {
    Scene scene = floor_scene();
    scene.materials.push_back({Diffuse{Rgb(0)}, false});
    scene.shapes.push_back({Sphere{{-2, 2, 0}, 1, true}, 1, Rgb(radiance)});
    scene.lights.points = {{{0, 1, 0}, Rgb(3)}};
    check(std::move(scene), .5 / pi * 3, fmt::format("radiance {:g}", radiance), 1 << 15);
  }
}

/// A level square of 2 count^2 triangles at a height.
Mesh tiled_square(std::uint32_t count, float height) {
  Mesh mesh;
  for (std::uint32_t i = 0; i <= count; ++i) {
    for (std::uint32_t k = 0; k <= count; ++k)
      mesh.positions.push_back({2 * static_cast<float>(i) / static_cast<float>(count) - 1, height,
                                2 * static_cast<float>(k) / static_cast<float>(count) - 1});
  }
  for (std::uint32_t i = 0; i < count; ++i) {
    for (std::uint32_t k = 0; k < count; ++k) {
      const std::uint32_t a = i * (count + 1) + k, b = a + count + 1;
      mesh.triangles.push_back({a, b, b + 1});
      mesh.triangles.push_back({a, b + 1, a + 1});
    }
  }
  return mesh;
}

// A sixteenth of the choices is shared equally by all lights; a mesh counts as one of them, however
// many triangles it has.
TEST_CASE("A light is seen beside a hidden mesh of many triangles that shines") {
  for (const std::uint32_t count : {1U, 4U, 32U, 256U}) {
    Scene scene = floor_scene();
    scene.materials.push_back({Diffuse{Rgb(0)}, true});
    scene.shapes.push_back({tiled_square(count, 3), 1, Rgb(1e12f)});
    scene.shapes.push_back({Parallelogram{{-5, 2, -5}, {0, 0, 10}, {10, 0, 0}}, 1});
    scene.lights.points = {{{0, 1, 0}, Rgb(3)}};
    check(std::move(scene), .5 / pi * 3, fmt::format("{} triangles", 2 * count * count), 1 << 14);
  }
}

}  // namespace
