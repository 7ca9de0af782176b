#include "lane_scenes.h"

#include "lab_scenes.h"
#include "random/rng.h"
#include "renderer/lanes/lane_scene.h"
#include "scene/needs.h"
#include "scene_tools.h"

#include <cmath>
#include <utility>

namespace lane_scenes {

using namespace scene_tools;

/// Features that no scene of the tree has: lights of different power, one of them on a one-sided
/// wall that is seen from behind as well, a sky, slanted and polished plates, a limit to the depth.
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
             Rgb radiance) {
  const auto add = [&](Vec3 at, Vec3 a, Vec3 b) {
    scene.shapes.push_back({Parallelogram{at, a, b}, material, radiance});
  };
  add(origin, v, u), add(origin + w, u, v);
  add(origin, w, v), add(origin + u, v, w);
  add(origin, u, w), add(origin + v, w, u);
}

/// Boxes of all kinds: a closed one around the camera, a slanted one, an emitting one, one that
/// extends into the floor; and spheres, one of which is black from outside.
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

/// Mirrors, glass and round lights: a closed room with a mirrored block, a block of glass, a pane
/// before a wall, balls of both; lights of different power that shine outwards, one of them behind
/// glass, and one that shines inwards, with something inside.
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

/// Signed distance functions of all forms and operations, one standing on the floor, of all
/// materials, under a disk light and a point light.
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
/// with a ball inside, one of mirrors, and a polished one; lights made of triangles, one closed,
/// one a trough that lights itself, under an emitting ball and a point.
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

/// A rotated image, black below, with one bright texel, around a room that lacks one wall and the
/// ceiling of a box; in it surfaces of all kinds and materials, with a mesh first, and all kinds of
/// lights.
Scene skylit() {
  Scene scene = modelled();
  carlo::Envmap map{carlo::Image(12, 6)};
  for (int i = 0; i < 12 * 4; ++i)
    map.image.pixels[static_cast<std::size_t>(i)] =
        static_cast<float>(i % 7) * Rgb(.05f, .08f, .1f);
  map.image.at(7, 1) = Rgb(20, 18, 15);
  map.rotation = {{.8, .6, 0}, {0, 0, 1}, {.6, -.8, 0}};
  scene.lights.envmap = std::move(map);
  const carlo::Mesh plate{{{-2, -2, .5f}, {-1, -2, .5f}, {-1, -1, .7f}}, {{0, 1, 2}}};
  scene.shapes.insert(scene.shapes.begin(), {plate, 1, Rgb(0)});
  scene.shapes.push_back({carlo::Mesh{{{1, 1, 2}, {1, 2, 2}, {2, 1, 2}}, {{0, 1, 2}}}, 2, Rgb(6)});
  scene.shapes.push_back({carlo::Sphere{{-1.5f, 1.5f, .5f}, .5f}, 1, Rgb(0)});
  scene.shapes.push_back({carlo::Sphere{{1.5f, -2, .3f}, .2f}, 2, Rgb(3, 4, 5)});
  scene.shapes.push_back({Parallelogram{{-3, 3, 0}, {6, 0, 0}, {0, 0, 3}}, 0, Rgb(0)});
  scene.shapes.push_back({Parallelogram{{3, -3, 0}, {0, 6, 0}, {0, 0, 3}}, 0, Rgb(0)});
  add_box(scene, {-1.8f, -.6f, 0}, {.5f, .1f, 0}, {-.1f, .5f, 0}, {0, 0, 1.2f}, 0);
  return scene;
}

/// More shapes and more lights than are tried one by one, of all kinds and materials: over a floor
/// and under a sky, some in the floor's plane, some touching each other.
Scene crowded() {
  Scene scene = skylit();
  carlo::Rng rng(4, 0);
  const auto between = [&](float low, float high) {
    return low + (high - low) * static_cast<float>(rng.uniform());
  };
  const auto place = [&](float low) {
    const float x = between(-2.5f, 2.5f), y = between(-2.5f, 2.5f);
    return Vec3(x, y, between(low, 1.5f));
  };
  for (std::uint32_t i = 0; i < 150; ++i) {
    const std::uint32_t material = i % 5;
    const bool emits = i % 3 == 0 && material < 4;
    const Rgb radiance = emits ? between(1, 30) * Rgb(1, 0.8f, 0.6f) : Rgb(0);
    const float size = between(0.03f, 0.12f);
    scene.shapes.push_back({carlo::Sphere{place(0.2f), size}, material, radiance});
    const Vec3 at = place(0.2f), normal = glm::normalize(place(-1.5f));
    scene.shapes.push_back({carlo::Disk{at, normal, size}, material, radiance});
    Vec3 corner = place(0.2f);
    if (i % 7 == 0) corner.z = 0;
    scene.shapes.push_back(
        {Parallelogram{corner, {size, 0, 0}, {0, -size, 0}}, material, radiance});
    if (i % 4 == 0) scene.lights.points.push_back({place(0.3f), between(0.01f, 0.1f) * Rgb(1)});
  }
  return scene;
}

std::vector<Named> all() {
  std::vector<Named> scenes{{"assorted", assorted()},
                            {"boxes", boxes()},
                            {"polished", polished()},
                            {"modelled", modelled()},
                            {"triangulated", triangulated()},
                            {"skylit", skylit()},
                            {"crowded", crowded()}};
  for (const std::string& name : lab_scenes::names()) {
    Scene scene = lab_scenes::load(name);
    if (renderer::LaneScene::suits(needs(scene), scene)) scenes.push_back({name, std::move(scene)});
  }
  return scenes;
}

}  // namespace lane_scenes
