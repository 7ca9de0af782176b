// Under a sky of radiance 1, solids whose surfaces reflect rho and emit 1 - rho: every ray has
// radiance 1, so each surface sends out (1 - rho) + rho = 1, and the film is 1, however the solids
// stand, overlap or shade each other, and however that is rounded. Rays that leak into a solid are
// lost on the black backs of its surfaces, and surfaces that are lit twice exceed 1. With rho = 1
// only the sky emits ("white").

#include "proving/ground.h"
#include "proving/parts.h"

#include <fmt/core.h>

#include <cstddef>
#include <string>
#include <utility>

namespace proving {
namespace {

using carlo::Rgb, carlo::Scene;
using glm::dvec3;

/// Finish i has albedo i of these, and emits the rest up to 1.
const Rgb open_albedos[] = {Rgb(.5f), Rgb(.25f, .5f, .75f), Rgb(.75f, .125f, .5f)};

Finish open_finish(std::uint32_t i) {
  return {i % 3, Rgb(1) - open_albedos[i % 3]};
}

Scene open_scene() {
  Scene scene = empty();
  scene.lights.environment = Rgb(1);
  for (const Rgb& albedo : open_albedos)
    scene.materials.push_back(diffuse(albedo, false));
  return scene;
}

Proof open_proof(std::string name, Scene scene, std::uint32_t spp) {
  return {"open/" + std::move(name), std::move(scene), exact_of(1), spp};
}

/// From above, or from between the two.
carlo::Camera gap_camera(double gap, bool between) {
  return between ? camera_at({.7, .4 * gap, .5}, {-.5, .45 * gap, -.3}, 80)
                 : camera_at({1.9, .5, 1.2}, {.9, 0, .4}, 60);
}

/// One slab, seen from above or from between it and the floor.
void add_slab(std::vector<Proof>& proofs, double half, double gap, int turn, bool between) {
  if (gap == 0 && between) return;
  Scene scene = open_scene();
  scene.shapes = {level(half, 0, open_finish(0))};
  add_box(scene, {{0, gap + .01, 0}, {1, .01, 1}}, open_finish(1), Facing::outwards);
  scene.camera = gap_camera(gap, between);
  Proof proof = open_proof(fmt::format("slab/half={:g}/gap={:g}/turn={}/{}", half, gap, turn,
                                       between ? "between" : "above"),
                           placed(std::move(scene), {rotation(turn)}), 256);
  // After rotation, the floor's own plane is accurate to half x 2^-24: the camera may be below it.
  proof.limit = between && turn != 0 && gap < half * 1e-6;
  proofs.push_back(std::move(proof));
}

/// The floor is seen only from above. Its half side is at least 100: from below its edge nothing
/// that stands on it is visible.
void slabs_over_floors(std::vector<Proof>& proofs) {
  for (const double half : {1e2, 1e3, 1e4, 1e5}) {
    for (const double gap : {0.0, 1e-4, 1e-3, 1e-2, 1e-1}) {
      for (const int turn : {0, 1}) {
        for (const bool between : {false, true})
          add_slab(proofs, half, gap, turn, between);
      }
    }
  }
}

void balls_on_floors(std::vector<Proof>& proofs) {
  for (const double half : {1e2, 1e3, 1e5}) {
    for (const double r : {.005, .02, .1, .5, 1.0}) {
      for (const bool sunk : {false, true}) {
        Scene scene = open_scene();
        scene.shapes = {level(half, 0, open_finish(1))};
        for (std::uint32_t i = 0; i < 4; ++i) {
          const std::uint32_t row = i / 2;
          const dvec3 at(2.1 * r * (i % 2), sunk ? .6 * r : r, 2.1 * r * row);
          scene.shapes.push_back(ball(at, r, open_finish(i)));
        }
        scene.camera = camera_at(r * dvec3(6, 4, 5), r * dvec3(1, .5, 1), 50);
        proofs.push_back(open_proof(
            fmt::format("balls/half={:g}/radius={:g}/{}", half, r, sunk ? "sunk" : "resting"),
            std::move(scene), 256));
      }
    }
  }
}

/// Boxes, and optionally balls, of sizes from .01 to 1 around the camera, which is in none of them
/// and looks at the first, a large one. A film that sees little but the sky would have a skewed
/// mean.
Scene crowd(std::uint64_t seed, int count, bool balls) {
  Random random(seed);
  Scene scene = open_scene();
  dvec3 first(0);
  for (int i = 0; i < count; ++i) {
    const double size = i == 0 ? .8 : random.magnitude(.01, 1);
    const dvec3 centre = (.1 + size * random.uniform(1.8, 4)) * random.direction();
    if (i == 0) first = centre;
    const Finish finish = open_finish(static_cast<std::uint32_t>(i));
    if (balls && i % 3 == 0) {
      scene.shapes.push_back(ball(centre, size, finish));
    } else {
      const dvec3 half =
          size * dvec3(random.uniform(.05, 1), random.uniform(.05, 1), random.uniform(.05, 1));
      add_box(scene, {centre, half, rotation(static_cast<int>(seed) + i)}, finish,
              Facing::outwards);
    }
  }
  scene.camera = camera_at({0, 0, 0}, first, 70);
  return scene;
}

void crowds(std::vector<Proof>& proofs) {
  int number = 0;
  for (const int count : {2, 4, 12}) {
    for (const double scale : {1e-4, 1.0, 1e4, 1e6}) {
      for (int i = 0; i < 6; ++i) {
        const Placement placement{rotation(++number), scale};
        const bool balls = i % 2 == 0;
        proofs.push_back(open_proof(
            fmt::format("crowd/{} {}/scale={:g}/{}", count, balls ? "mixed" : "boxes", scale,
                        number),
            placed(crowd(static_cast<std::uint64_t>(number), count, balls), placement), 256));
      }
    }
  }
}

/// The same solids, all of albedo 1.
void whiten(std::vector<Proof>& proofs) {
  const std::size_t count = proofs.size();
  for (std::size_t i = 0; i < count; ++i) {
    // Paths in a gap between white walls would take (size / gap)^2 steps to leave it.
    const bool narrow = proofs[i].name.find("gap=0.0") != std::string::npos;
    if (narrow || proofs[i].limit) continue;
    Proof white = proofs[i];
    white.name = "white/" + white.name.substr(white.name.find('/') + 1);
    for (carlo::Material& material : white.scene.materials)
      material = diffuse(Rgb(1), false);
    for (carlo::Shape& shape : white.scene.shapes)
      shape.radiance = Rgb(0);
    proofs.push_back(std::move(white));
  }
}

}  // namespace

std::vector<Proof> open_furnace_proofs() {
  std::vector<Proof> proofs;
  slabs_over_floors(proofs);
  balls_on_floors(proofs);
  crowds(proofs);
  whiten(proofs);
  return proofs;
}

}  // namespace proving
