// The vector kernel and the scalar integrator agree: on every tile and in the mean of every scene
// that the kernel takes, with Sobol' and with independent points. A tile's channel is outside of 5
// standard errors with probability 5.7e-7, the image outside of 3 with 2.7e-3: of the 38 images'
// three channels, which go together in most, another seed would fail somewhere with probability .1
// to .25, so the seed is fixed. Standard errors of Sobol' points are upper bounds. Power: as in
// agreement_test.cpp, whose deviations of 8 (tiles) and 6 (images) standard errors are seen with
// probability .999; both sides get 1024 samples a pixel.

#include "renderer/lanes/lane_kernel.h"

#include "lab_scenes.h"
#include "renderer/lanes/lane_boxes.h"
#include "renderer/lanes/lane_scene.h"
#include "scene/needs.h"
#include "scene_tools.h"
#include "tiles.h"

#include <catch2/catch_test_macros.hpp>
#include <fmt/core.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

namespace {

using namespace scene_tools;

struct Named {
  std::string name;
  Scene scene;
};

/// What no scene of ours has: lights of different power, one of them on a one-sided wall that is
/// seen from behind as well, a sky, slanted and polished plates, a limit to the depth.
Scene assorted() {
  Scene scene;
  scene.materials = {{Diffuse{Rgb(0.7f, 0.6f, 0.5f)}, true},
                     {Diffuse{Rgb(0.2f, 0.5f, 0.8f)}, false},
                     {Phong{Rgb(0.3f), Rgb(0.5f, 0.6f, 0.4f), 40}, true},
                     {Phong{Rgb(0), Rgb(0.9f), 3}, false}};
  const auto add = [&](Vec3 origin, Vec3 u, Vec3 v, std::uint32_t material, Rgb radiance) {
    scene.shapes.push_back({Parallelogram{origin, u, v}, material, radiance});
  };
  add({-2, -2, 0}, {4, 0, 0}, {0, 4, 0}, 0, Rgb(0));
  add({-2, 2, 0}, {4, 0, 0}, {0.5f, 0, 3}, 2, Rgb(0));
  add({-2, -1, 0.2f}, {0, 2, 0}, {0.3f, 0.4f, 2}, 1, Rgb(0.3f, 0.2f, 0.1f));
  add({1.2f, -0.5f, 0.1f}, {0, 1.5f, 0}, {0.2f, 0, 1.2f}, 3, Rgb(0));
  add({-0.5f, 0.5f, 2.5f}, {0, -0.6f, 0}, {0.8f, 0, 0}, 1, Rgb(6, 5, 4));
  add({0.6f, -1.5f, 1}, {0.2f, 0, 0}, {0, 0.2f, 0.1f}, 0, Rgb(9));
  scene.lights.environment = Rgb(0.1f, 0.2f, 0.3f);
  scene.max_depth = 5;
  scene.camera = scene_tools::look_at({0.3f, -5, 1.8f}, {0, 0, 1}, {0, 0, 1}, 45);
  return scene;
}

void add_box(Scene& scene, Vec3 origin, Vec3 u, Vec3 v, Vec3 w, std::uint32_t material,
             Rgb radiance = Rgb(0)) {
  const auto add = [&](Vec3 at, Vec3 a, Vec3 b) {
    scene.shapes.push_back({Parallelogram{at, a, b}, material, radiance});
  };
  add(origin, v, u), add(origin + w, u, v);
  add(origin, w, v), add(origin + u, v, w);
  add(origin, u, w), add(origin + v, w, u);
}

/// Boxes of all kinds: a closed one around the camera, a slanted one, one that shines, one that
/// sinks into the floor; and spheres, one of which is black from outside.
Scene boxes() {
  Scene scene;
  scene.materials = {{Diffuse{Rgb(0.6f, 0.5f, 0.4f)}, true},
                     {Phong{Rgb(0.3f), Rgb(0.4f, 0.5f, 0.6f), 20}, true},
                     {Diffuse{Rgb(0.8f)}, false}};
  add_box(scene, {-2, -2, 0}, {4, 0, 0}, {0, 4, 0}, {0, 0, 3}, 0);
  add_box(scene, {-1, 0, 0}, {0.8f, 0, 0}, {0.2f, 0.7f, 0}, {0.1f, 0.2f, 1}, 1);
  add_box(scene, {-0.4f, 0.5f, 0}, {0.9f, 0.3f, 0}, {-0.3f, 0.9f, 0}, {0, 0, 0.7f}, 2);
  add_box(scene, {-0.2f, 0, 2.5f}, {0.4f, 0, 0}, {0, 0.4f, 0}, {0, 0, 0.2f}, 2, Rgb(5, 4, 3));
  scene.shapes.push_back({carlo::Sphere{{0, -0.5f, 0.4f}, 0.4f}, 1, Rgb(0)});
  scene.shapes.push_back({carlo::Sphere{{1.3f, -0.4f, 0.3f}, 0.3f, true}, 2, Rgb(0)});
  scene.camera = scene_tools::look_at({0.1f, -1.9f, 1.4f}, {0, 0, 1}, {0, 0, 1}, 70);
  return scene;
}

/// Mirrors, glass and round lamps: a closed room with a mirror for a block, a block of glass, a
/// pane before a wall, balls of both; lamps of different power that shine outwards, one of them
/// behind glass, and one that shines inwards, with something in it.
Scene polished() {
  Scene scene;
  scene.materials = {{Diffuse{Rgb(0.6f, 0.5f, 0.4f)}, true},
                     {Phong{Rgb(0.3f), Rgb(0.4f, 0.5f, 0.6f), 20}, true},
                     {Diffuse{Rgb(0.5f)}, false},
                     {carlo::Mirror{Rgb(0.9f, 0.8f, 0.7f)}, true},
                     {carlo::Dielectric{1.5f, 1}, false},
                     {carlo::Dielectric{1, 1.33f}, false}};
  add_box(scene, {-2, -2, 0}, {4, 0, 0}, {0, 4, 0}, {0, 0, 3}, 0);
  add_box(scene, {-1, 0, 0}, {0.8f, 0, 0}, {0.2f, 0.7f, 0}, {0.1f, 0.2f, 1}, 3);
  add_box(scene, {0.5f, 0.4f, 0}, {0.7f, 0.2f, 0}, {-0.2f, 0.7f, 0}, {0, 0, 0.5f}, 4);
  scene.shapes.push_back({Parallelogram{{-1, 1.7f, 0.5f}, {2, 0, 0}, {0, 0, 2}}, 4, Rgb(0)});
  const auto add = [&](Vec3 center, float radius, bool flipped, std::uint32_t material,
                       Rgb radiance = Rgb(0)) {
    scene.shapes.push_back({carlo::Sphere{center, radius, flipped}, material, radiance});
  };
  add({-1.3f, -0.5f, 0.4f}, 0.4f, false, 4);
  add({-1.3f, -0.5f, 0.4f}, 0.2f, false, 5);
  add({1.4f, -0.6f, 0.4f}, 0.4f, false, 3);
  add({0.1f, -0.7f, 2}, 0.15f, false, 2, Rgb(12, 10, 8));
  add({0.9f, 0.7f, 1.3f}, 0.25f, false, 4);
  add({0.9f, 0.7f, 1.3f}, 0.05f, false, 2, Rgb(40));
  add({-0.6f, 0.4f, 1.6f}, 0.3f, true, 0, Rgb(0.5f, 0.8f, 1));
  add({-0.6f, 0.5f, 1.6f}, 0.1f, false, 1);
  add_box(scene, {-0.2f, 0.9f, 2.5f}, {0.4f, 0, 0}, {0, 0.4f, 0}, {0, 0, 0.2f}, 2, Rgb(2, 3, 4));
  scene.camera = scene_tools::look_at({0.1f, -1.9f, 1.4f}, {0, 0, 1}, {0, 0, 1}, 70);
  return scene;
}

/// Signed distance functions of all forms and operations, one that stands on the floor, of all
/// materials, under lamps that are a disk and a point.
Scene modelled() {
  namespace sdf = carlo::sdf;
  Scene scene;
  scene.materials = {{Diffuse{Rgb(0.6f, 0.5f, 0.4f)}, true},
                     {Phong{Rgb(0.3f), Rgb(0.4f, 0.5f, 0.6f), 20}, true},
                     {Diffuse{Rgb(0.5f)}, false},
                     {carlo::Mirror{Rgb(0.9f, 0.8f, 0.7f)}, true},
                     {carlo::Dielectric{1.5f, 1}, false}};
  scene.shapes.push_back({Parallelogram{{-3, -3, 0}, {6, 0, 0}, {0, 6, 0}}, 0, Rgb(0)});
  scene.shapes.push_back({carlo::Disk{{0, 0, 2.5f}, {0, 0, -1}, 0.4f}, 2, Rgb(8)});
  scene.lights.points.push_back({{1.5f, -1.5f, 2}, Rgb(2, 1.5f, 1)});
  const auto add = [&](std::vector<sdf::Step> steps, glm::dvec3 at, double scale,
                       std::uint32_t material, bool flipped = false) {
    const glm::dmat3 turn(0.8, 0.6, 0, -0.6, 0.8, 0, 0, 0, 1);
    scene.shapes.push_back(
        {carlo::Sdf{std::move(steps), {turn, at, scale}, flipped}, material, Rgb(0)});
  };
  const sdf::Solid box{sdf::RoundedBox{{0.5, 0.4, 0.3}, 0.1}, {}},
      bite{sdf::Ball{0.4}, {glm::dmat3(1), {0.4, 0, 0.3}, 1}},
      rod{sdf::Capsule{{0, 0, -0.5}, {0, 0, 0.5}, 0.2}, {}};
  add({box, bite, sdf::Combine{sdf::Operation::subtract, 0.05}}, {-0.8, 0.3, 0.3}, 1, 2);
  add({sdf::Solid{sdf::Torus{0.4, 0.15}, {}}}, {0.6, -0.6, 0.4}, 1, 4);
  add({rod, sdf::Solid{sdf::Ball{0.3}, {glm::dmat3(1), {0, 0, 0.6}, 0.8}},
       sdf::Combine{sdf::Operation::unite, 0.2}},
      {0.8, 0.8, 0.5}, 0.7, 3);
  add({sdf::Solid{sdf::Ball{1}, {}}, sdf::Solid{sdf::Gyroid{0.9, 0.1}, {}},
       sdf::Combine{sdf::Operation::intersect, 0.02}},
      {-0.3, -0.8, 0.45}, 0.4, 1, true);
  scene.camera = scene_tools::look_at({0.1f, -3.5f, 1.8f}, {0, 0, 0.5f}, {0, 0, 1}, 45);
  return scene;
}

/// Meshes of all materials in a room, some on its floor and in its walls' planes: a block of glass
/// with a ball in it, one of mirrors, and a polished one; lamps of triangles, one closed, one a
/// trough that lights itself, under a ball that shines and a point.
Scene triangulated() {
  Scene scene = polished();
  scene.shapes.clear();
  const auto add = [&](Vec3 o, Vec3 u, Vec3 v, Vec3 w, std::uint32_t material,
                       Rgb radiance = Rgb(0)) {
    const auto at = [&](int i) {
      return o + static_cast<float>(i & 1) * u + static_cast<float>(i >> 1 & 1) * v +
             static_cast<float>(i >> 2) * w;
    };
    carlo::Mesh mesh{{at(0), at(1), at(2), at(3), at(4), at(5), at(6), at(7)},
                     {{0, 2, 1},
                      {1, 2, 3},
                      {4, 5, 6},
                      {5, 7, 6},
                      {0, 1, 4},
                      {1, 5, 4},
                      {2, 6, 3},
                      {3, 6, 7},
                      {0, 4, 2},
                      {2, 4, 6},
                      {1, 3, 5},
                      {3, 7, 5}}};
    scene.shapes.push_back({std::move(mesh), material, radiance});
  };
  add_box(scene, {-2, -2, 0}, {4, 0, 0}, {0, 4, 0}, {0, 0, 3}, 0);
  add({0.5f, 0.4f, 0.02f}, {0.7f, 0.2f, 0}, {-0.2f, 0.7f, 0}, {0, 0, 0.5f}, 4);
  scene.shapes.push_back({carlo::Sphere{{0.75f, 0.85f, 0.27f}, 0.2f}, 0, Rgb(0)});
  add({-1, 0, 0}, {0.8f, 0, 0}, {0.2f, 0.7f, 0}, {0.1f, 0.2f, 1}, 3);
  add({1.2f, 1, 1}, {0.8f, 0, 0}, {0, 1, 0}, {0, 0, 0.4f}, 1);
  add({-1.4f, -0.6f, 0}, {0.5f, 0.1f, 0}, {0, 0.5f, 0.1f}, {0, 0, 0.6f}, 2);
  add({-0.2f, 0.9f, 2.7f}, {0.4f, 0, 0}, {0, 0.4f, 0}, {0, 0, 0.3f}, 2, Rgb(6, 5, 4));
  scene.shapes.push_back({carlo::Mesh{{{0.5f, -0.8f, 1.2f},
                                       {1.1f, -0.8f, 1.2f},
                                       {0.5f, -0.5f, 1},
                                       {1.1f, -0.5f, 1},
                                       {0.5f, -0.2f, 1.2f},
                                       {1.1f, -0.2f, 1.2f}},
                                      {{0, 2, 1}, {1, 2, 3}, {2, 4, 3}, {3, 4, 5}}},
                          2, Rgb(1, 2, 3)});
  scene.shapes.push_back({carlo::Sphere{{0.1f, -0.7f, 2}, 0.15f}, 2, Rgb(6, 5, 4)});
  scene.lights.points.push_back({{-1.5f, -1.5f, 2}, Rgb(1, 1.5f, 2)});
  return scene;
}

/// The scenes of the tree that the kernel takes, and the five above.
std::vector<Named> lane_scenes() {
  std::vector<Named> scenes{{"assorted", assorted()},
                            {"boxes", boxes()},
                            {"polished", polished()},
                            {"modelled", modelled()},
                            {"triangulated", triangulated()}};
  for (const std::string& name : lab_scenes::names()) {
    Scene scene = lab_scenes::load(name);
    if (renderer::LaneScene::suits(needs(scene), scene)) scenes.push_back({name, std::move(scene)});
  }
  return scenes;
}

Scene small(Scene scene, SamplerKind sampler) {
  resize(scene, 32, 32);
  scene.sampler = sampler;
  return scene;
}

tiles::Estimate estimate(const Scene& scene, renderer::Kernel kernel, std::uint64_t seed) {
  constexpr tiles::Samples samples{32, 32};
  const auto integrator = renderer::make_path_integrator(
      scene, {.seed = seed, .spp = samples.per_pixel(), .kernel = kernel});
  return tiles::estimate(*integrator, scene.width, 8, samples);
}

}  // namespace

TEST_CASE("The vector kernel agrees with the scalar integrator") {
  const std::vector<Named> scenes = lane_scenes();
  REQUIRE(scenes.size() >= 19);
  for (const auto& [name, full] : scenes) {
    REQUIRE(renderer::LaneScene::suits(needs(full), full));
    const Scene oracle_scene = small(full, SamplerKind::independent);
    const tiles::Estimate oracle = estimate(oracle_scene, renderer::Kernel::scalar, 1);
    for (const SamplerKind sampler : {SamplerKind::independent, SamplerKind::sobol}) {
      const Scene scene = small(full, sampler);
      const tiles::Estimate kernel = estimate(scene, renderer::Kernel::best, 2);
      double worst = 0, whole = 0;
      for (std::size_t c = 0; c < 3; ++c) {
        whole = std::max(whole, std::abs(tiles::z(oracle.whole[c], kernel.whole[c])));
        for (std::size_t i = 0; i < oracle.tiles.size(); ++i) {
          worst = std::max(worst, std::abs(tiles::z(oracle.tiles[i][c], kernel.tiles[i][c])));
        }
      }
      INFO(name << (sampler == SamplerKind::sobol ? ", Sobol'" : ", independent") << ": worst tile "
                << worst << ", image " << whole);
      fmt::print("{:<20} tile |z| {:.2f}, image |z| {:.2f}\n", name, worst, whole);
      CHECK(worst <= 5);
      CHECK(whole <= 3);
      CHECK(kernel.counts.bad == 0);
    }
  }
}

TEST_CASE("The vector kernel finds boxes") {
  const renderer::LaneBoxes found = renderer::find_boxes(boxes());
  CHECK(found.solids.size() == 2);
  REQUIRE(found.enclosure);
  CHECK(found.enclosure->box.faces == 0x3F);
  CHECK(found.camera_inside);
  CHECK(found.others.size() == 6);  // what shines

  const renderer::LaneBoxes cornell = renderer::find_boxes(lab_scenes::load("cornell_phong"));
  CHECK(cornell.solids.size() == 2);
  REQUIRE(cornell.enclosure);
  CHECK(std::popcount(cornell.enclosure->box.faces) == 5);
  CHECK_FALSE(cornell.camera_inside);
  CHECK(cornell.others.size() == 1);

  // From outside, the walls are no enclosure; from inside of a block, it is not solid, and its
  // floor covers a part of the other's.
  Scene scene = boxes();
  scene.camera.origin = {0, -2.1f, 1};
  CHECK_FALSE(renderer::find_boxes(scene).enclosure);
  scene.camera.origin = {-0.5f, 0.4f, 0.5f};
  CHECK(renderer::find_boxes(scene).solids.empty());
  CHECK(renderer::find_boxes(assorted()).others.size() == assorted().shapes.size());
}

// Instruction sets draw the same points and differ in rounding, so their images differ far less
// than by 3 of their standard errors; a wrong lane or lookup does not.
TEST_CASE("The vector kernel's images agree on all instruction sets") {
  for (const Scene& full :
       {boxes(), polished(), modelled(), triangulated(), lab_scenes::load("cornell_phong")}) {
    const Scene scene = small(full, SamplerKind::sobol);
    const tiles::Estimate best = estimate(scene, renderer::Kernel::best, 1);
    for (const std::string& name : renderer::lane_instruction_sets()) {
      renderer::use_instruction_set(name);
      const tiles::Estimate other = estimate(scene, renderer::Kernel::best, 1);
      renderer::use_instruction_set("");
      double worst = 0;
      for (std::size_t c = 0; c < 3; ++c) {
        for (std::size_t i = 0; i < best.tiles.size(); ++i)
          worst = std::max(worst, std::abs(tiles::z(best.tiles[i][c], other.tiles[i][c])));
      }
      INFO(name << ": " << worst);
      fmt::print("{:<20} tile |z| {:.3f}\n", name, worst);
      CHECK(worst <= 3);
      CHECK(other.counts.bad == 0);
    }
  }
}

TEST_CASE("The vector kernel's image has the same bits for any number of threads") {
  const Scene scene = small(lab_scenes::load("cornell_phong"), SamplerKind::sobol);
  const Image one = render_scene(scene, 16, 1, 1).film.mean();
  for (const int threads : {2, 3, 8}) {
    const Image more = render_scene(scene, 16, 1, threads).film.mean();
    CHECK(std::equal(one.pixels.begin(), one.pixels.end(), more.pixels.begin()));
  }
}
