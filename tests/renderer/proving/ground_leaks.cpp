// A closed room without emission is black, whatever shines outside. A path of 50 segments has 50
// chances to see through a wall. A lit room beside a dark one has radiance E / (1 - rho) as always.

#include "proving/ground.h"
#include "proving/parts.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <utility>

namespace proving {
namespace {

using carlo::Rgb, carlo::Scene;
using glm::dvec3;

Scene leak_scene(float albedo, bool two_sided) {
  Scene scene = empty(4);
  scene.max_depth = 50;
  scene.materials = {diffuse(Rgb(albedo), two_sided)};
  scene.camera = camera_at({.1, .2, .3}, {1, .9, 1.1}, 100);
  return scene;
}

Proof leak_proof(std::string name, Scene scene, const Placement& placement) {
  return {"leak/" + std::move(name), placed(std::move(scene), placement), exact_of(0), 128, 0};
}

/// The fraction of bounces so near an edge that rounding the point, by up to 2^-24 of its
/// coordinates, may move it past the other wall. The 12 edges of length 2 have 24 x 2 times that as
/// area, of 24, on both sides.
double lost_at_edges(double shift) {
  return 2 * 0x1p-24 * std::max(1.0, shift);
}

void boxes_under_sky(std::vector<Proof>& proofs, double shift, int turn, float albedo,
                     double margin) {
  Scene scene = leak_scene(albedo, turn % 2 == 0);
  scene.lights.environment = Rgb(1);
  add_box(scene, {dvec3(0), dvec3(1), glm::dmat3(1), margin}, {}, Facing::inwards);
  proofs.push_back(leak_proof(fmt::format("box/shift={:g}/turn={}/albedo={:g}/{}", shift, turn,
                                          albedo, margin == 0 ? "edge to edge" : "crossing"),
                              std::move(scene),
                              {rotation(turn), 1, shift * dvec3(1, turn == 0 ? 0 : -.6, .5)}));
  // Paths have 50 segments, or about two for albedo .5.
  proofs.back().rounding = (albedo == 1 ? 50 : 2) * lost_at_edges(shift);
  // At 1e5 a coordinate is rounded by 4e-3. After rotation and translation, corners that coincided
  // are rounded apart: the walls have gaps.
  proofs.back().limit = shift >= 1e5 || (margin == 0 && turn != 0 && shift > 0);
}

/// Exact: 0, except for hits on edges. Walls that cross stay closed when rounded; walls that meet
/// edge to edge do if they are axis-aligned, and nearly (1e-8 of a wall) when rotated about the
/// origin.
void sealed_boxes(std::vector<Proof>& proofs) {
  for (const double shift : {0.0, 100.0, 1e3, 1e4, 1e5}) {
    for (int turn = 0; turn < 6; ++turn) {
      for (const float albedo : {1.0f, .5f})
        boxes_under_sky(proofs, shift, turn, albedo, .05);
    }
    boxes_under_sky(proofs, shift, 0, 1, 0);
  }
  for (int turn = 1; turn < 9; ++turn)
    boxes_under_sky(proofs, 0, turn, 1, 0);
  boxes_under_sky(proofs, 100, 3, 1, 0);
}

/// Exact: 0.
void sealed_spheres(std::vector<Proof>& proofs) {
  for (const double shift : {0.0, 2.7, 100.0, 1e4, 1e5}) {
    for (const bool two_sided : {true, false}) {
      Scene scene = leak_scene(1, two_sided);
      scene.lights.environment = Rgb(1);
      scene.shapes = {ball({0, 0, 0}, 2, {}, Facing::inwards)};
      proofs.push_back(leak_proof(
          fmt::format("sphere/shift={:g}/{}", shift, two_sided ? "two-sided" : "one-sided"),
          std::move(scene), {rotation(0), 1, shift * dvec3(1, .9, -1.7)}));
      // In the lanes, whose positions are floats. Loaded from a file, the scene would be moved to
      // the origin.
      proofs.back().limit = shift >= 1e4;
    }
  }
}

/// Two rooms of half side 1, side by side along x, `gap` apart: the one on the right is lit.
Scene two_rooms(bool two_sided, double gap, bool in_the_light) {
  Scene scene = leak_scene(.5f, two_sided);
  if (in_the_light) scene.max_depth = 0;
  add_box(scene, {{0, 0, 0}}, {}, Facing::inwards);
  add_box(scene, {{2 + gap, 0, 0}}, {0, Rgb(1)}, Facing::inwards);
  if (in_the_light) scene.camera.origin.x += static_cast<float>(2 + gap);
  return scene;
}

/// Exact: 0 in the dark room, even where the two walls between the rooms are in one plane:
/// whichever is hit, the dark room sees a wall that does not emit on this side. 1 / (1 - .5) in the
/// lit room: of two walls in one plane a ray meets one that faces it (common/scene/README.md,
/// limits).
void neighbours(std::vector<Proof>& proofs) {
  for (const double gap : {0.0, 1e-4, 1e-3, 1e-1}) {
    for (const bool two_sided : {false, true}) {
      for (const int turn : {0, 11, 12}) {
        for (const bool in_the_light : {false, true}) {
          Proof proof = leak_proof(fmt::format("rooms/gap={:g}/{}/turn={}/{}", gap,
                                               two_sided ? "two-sided" : "one-sided", turn,
                                               in_the_light ? "lit" : "dark"),
                                   two_rooms(two_sided, gap, in_the_light), {rotation(turn)});
          if (in_the_light) proof.exact = exact_of(2), proof.rounding = 1e-5, proof.spp = 1024;
          proofs.push_back(std::move(proof));
        }
      }
    }
  }
}

enum class Enclosed { panel, ball, disk, point };

void add_light(Scene& scene, Enclosed light, dvec3 at) {
  const Finish shining{0, Rgb(10)};
  if (light == Enclosed::panel)
    scene.shapes.push_back(panel(at, {0, .04, 0}, {0, 0, .04}, shining));
  else if (light == Enclosed::ball)
    scene.shapes.push_back(ball(at, .04, shining));
  else if (light == Enclosed::disk)
    scene.shapes.push_back({carlo::Disk{carlo::Vec3(at), {1, 0, 0}, .04f}, 0, Rgb(10)});
  else
    scene.lights.points.push_back({carlo::Vec3(at), Rgb(10)});
}

/// A light in a closed box, and a floor outside. Exact: 0.
void lights_in_boxes(std::vector<Proof>& proofs) {
  const std::array<const char*, 4> names = {"panel", "ball", "disk", "point"};
  for (std::size_t light = 0; light < names.size(); ++light) {
    for (const double place : {0.0, .4}) {
      for (const int turn : {0, 3, 5}) {
        Scene scene = leak_scene(.5f, true);
        scene.camera = camera_at({2, 1, 1.5}, {0, 0, 0}, 60);
        scene.shapes = {level(10, -.6)};
        add_box(scene, {dvec3(0), dvec3(.5)}, {}, Facing::outwards);
        add_light(scene, static_cast<Enclosed>(light), {place, .1, .2});
        proofs.push_back(
            leak_proof(fmt::format("light/{}/at={:g}/turn={}", names[light], place, turn),
                       std::move(scene), {rotation(turn)}));
      }
    }
  }
}

}  // namespace

std::vector<Proof> leak_proofs() {
  std::vector<Proof> proofs;
  sealed_boxes(proofs);
  sealed_spheres(proofs);
  neighbours(proofs);
  lights_in_boxes(proofs);
  return proofs;
}

}  // namespace proving
