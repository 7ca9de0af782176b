// A convex light alone in the dark has nothing to reflect, so its radiance is its emission, 1,
// whatever its albedo. Each sample is exact: a light that lights itself because of rounding shows.

#include "proving/ground.h"
#include "proving/parts.h"

#include <fmt/core.h>

#include <string>
#include <utility>

namespace proving {
namespace {

using carlo::Rgb, carlo::Scene;
using glm::dvec3;

Scene emitter_scene(float albedo, bool two_sided) {
  Scene scene = empty();
  scene.materials = {diffuse(Rgb(albedo), two_sided)};
  return scene;
}

Proof emitter_proof(std::string name, Scene scene, const Placement& placement) {
  return {"emitter/" + std::move(name), placed(std::move(scene), placement), exact_of(1), 64};
}

const Finish shining{0, Rgb(1)};

/// The film sees a part of the rectangle, at up to 82 degrees to its normal.
void rectangles(std::vector<Proof>& proofs) {
  Random random(31);
  for (int i = 0; i < 48; ++i) {
    const double scale = std::array{1.0, 1e-4, 1e4, 1.0}[static_cast<std::size_t>(i % 4)];
    Scene scene = emitter_scene(i % 2 == 0 ? 1 : .5f, i % 3 == 0);
    scene.shapes = {panel({0, 0, 0}, {1, 0, 0}, {0, random.magnitude(.3, 3), 0}, shining)};
    const double tilt = random.uniform(.15, 1.5);
    scene.camera = camera_at({random.uniform(-.2, .2), 2, 2 * tilt}, {.05, .02, 0}, 1);
    const dvec3 shift = i % 4 == 3 ? 100.0 * random.direction() : random.direction();
    proofs.push_back(emitter_proof(fmt::format("rectangle/{}/scale={:g}", i, scale),
                                   std::move(scene), {rotation(i), scale, shift}));
  }
}

/// A ball at positions relative to its size: radius .37 at (3, 2.7, -5) and the like.
void spheres_alone(std::vector<Proof>& proofs) {
  Random random(32);
  for (const double radius : {1e-4, 1e-2, .37, 1.0, 1e3, 1e5}) {
    for (int i = 0; i < 5; ++i) {
      Scene scene = emitter_scene(i % 2 == 0 ? 1 : .5f, i % 3 == 0);
      scene.shapes = {ball({0, 0, 0}, 1, shining)};
      const double distance = random.magnitude(1.05, 100);
      // The cone around the ball has sin = 1/distance; .8 of it is filled.
      scene.camera = camera_at(distance * random.direction(), {0, 0, 0}, 80 / distance);
      const dvec3 shift = (i == 0 ? 0 : random.magnitude(1, 100)) * random.direction();
      proofs.push_back(emitter_proof(fmt::format("sphere/radius={:g}/{}", radius, i),
                                     std::move(scene), {rotation(i), radius, shift}));
    }
  }
}

void other_lights(std::vector<Proof>& proofs) {
  const char* const names[] = {"disk", "octahedron", "box"};
  int number = 0;
  for (int kind = 0; kind < 3; ++kind) {
    for (const double scale : {1e-4, 1.0, 1e4}) {
      for (int i = 0; i < 5; ++i) {
        Scene scene = emitter_scene(i % 2 == 0 ? 1 : .5f, kind == 0 && i % 3 == 0);
        if (kind == 0) scene.shapes = {{carlo::Disk{{0, 0, 0}, {0, 0, 1}, 1}, 0, Rgb(1)}};
        if (kind == 1) scene.shapes = {octahedron({0, 0, 0}, 1, shining)};
        if (kind == 2)
          add_box(scene, {{0, 0, 0}, {1, .7, .6}, rotation(40 + i)}, shining, Facing::outwards);
        scene.camera = camera_at({.7, .9, 4}, {.05, .02, 0}, 8);
        const dvec3 shift = (i == 4 ? 300.0 : 2.7) * dvec3(.7, -.6, .3);
        proofs.push_back(emitter_proof(fmt::format("{}/scale={:g}/{}", names[kind], scale, i),
                                       std::move(scene), {rotation(++number), scale, shift}));
      }
    }
  }
}

}  // namespace

std::vector<Proof> emitter_proofs() {
  std::vector<Proof> proofs;
  rectangles(proofs);
  spheres_alone(proofs);
  other_lights(proofs);
  return proofs;
}

}  // namespace proving
