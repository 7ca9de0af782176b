// Under a uniform sky of radiance 1, a surface that sees nothing but the sky has its albedo as
// radiance: the integral of albedo/pi cos over the hemisphere. Nothing rises above a level floor or
// above the top of a card, and a convex solid does not see itself.

#include "proving/ground.h"
#include "proving/parts.h"

#include <fmt/core.h>

#include <string>
#include <utility>

namespace proving {
namespace {

using carlo::Rgb, carlo::Scene;
using glm::dvec3;

const Rgb sky_albedo(.25f, .5f, .75f);

Scene under_sky(bool two_sided) {
  Scene scene = empty();
  scene.lights.environment = Rgb(1);
  scene.materials = {diffuse(sky_albedo, two_sided)};
  return scene;
}

Proof sky_proof(std::string name, Scene scene) {
  return {"sky/" + std::move(name), std::move(scene), exact_of(sky_albedo), 256};
}

const char* side_name(bool two_sided) {
  return two_sided ? "two-sided" : "one-sided";
}

/// Exact: the albedo; a plane does not see itself.
void floors(std::vector<Proof>& proofs) {
  struct View {
    const char* name;
    dvec3 from, at;  ///< in half sides of the floor where `far`, else in units
    bool far;
  };
  const View views[] = {{"down", {0, 1, .01}, {0, 0, 0}, false},
                        {"slanted", {.5, .6, .3}, {0, 0, 0}, false},
                        {"low", {.4, .02, .1}, {.2, 0, .05}, false},
                        {"far", {.6, .3, -.6}, {.5, 0, .4}, true}};
  for (const double half : {1.0, 10.0, 1e2, 1e3, 1e4, 1e5}) {
    for (const View& view : views) {
      for (const int turn : {0, 1}) {
        Scene scene = under_sky(turn == 0);
        scene.shapes = {level(half, 0)};
        const double unit = view.far ? half : 1;
        scene.camera = camera_at(unit * view.from, unit * view.at, 5);
        proofs.push_back(sky_proof(fmt::format("floor/half={:g}/{}/turn={}", half, view.name, turn),
                                   placed(std::move(scene), {rotation(turn)})));
      }
    }
  }
}

/// Exact: the albedo, on the card's top; also on the floor 30 away, from where a card of height h
/// covers 4 (h/30)^2 / (pi 30^2) < 2e-8 of the hemisphere, weighted with the cosine.
void floating_cards(std::vector<Proof>& proofs) {
  for (const double half : {2.0, 1e2, 1e3, 1e5}) {
    for (const double h : {1e-1, 1e-2, 1e-3, 1e-4}) {
      for (const bool top : {true, false}) {
        if (!top && half < 1e2) continue;
        Scene scene = under_sky(true);
        scene.shapes = {level(half, 0), level(1, h)};
        const dvec3 at = top ? dvec3(.1, h, .2) : dvec3(30, 0, 5);
        scene.camera = camera_at(at + dvec3(.4, 1, .3), at, 20);
        proofs.push_back(sky_proof(
            fmt::format("card/half={:g}/height={:g}/{}", half, h, top ? "top" : "floor"), scene));
      }
    }
  }
}

/// Exact: the albedo, as for cards. The slab's bottom lies in the floor.
void slabs(std::vector<Proof>& proofs) {
  for (const double half : {2.0, 1e2, 1e3, 1e4, 1e5}) {
    for (const bool two_sided : {true, false}) {
      for (const bool top : {true, false}) {
        if (!top && half < 1e2) continue;
        Scene scene = under_sky(two_sided);
        scene.shapes = {level(half, 0)};
        add_box(scene, {{0, .01, 0}, {1, .01, 1}}, {}, Facing::outwards);
        const dvec3 at = top ? dvec3(.1, .02, .2) : dvec3(30, 0, 5);
        scene.camera = camera_at(at + dvec3(.4, 1, .3), at, 20);
        proofs.push_back(sky_proof(
            fmt::format("slab/half={:g}/{}/{}", half, side_name(two_sided), top ? "top" : "floor"),
            scene));
      }
    }
  }
}

/// Exact: the albedo; two floors in one plane reflect like one. One-sided ones face the same way.
void coplanar_floors(std::vector<Proof>& proofs) {
  for (const double half : {1.0, 1e3, 1e5}) {
    for (const std::string kind : {"same", "shifted", "smaller", "opposite"}) {
      for (const int turn : {0, 1, 2}) {
        const bool two_sided = kind == "opposite" || turn == 0;
        Scene scene = under_sky(two_sided);
        scene.shapes = {level(half, 0), level(kind == "smaller" ? .4 : half, 0)};
        auto& second = std::get<carlo::Parallelogram>(scene.shapes[1].geometry);
        if (kind == "shifted") second.origin.x += static_cast<float>(half);
        if (kind == "opposite") std::swap(second.u, second.v);
        // Across the edge of the second floor, if there is one.
        const dvec3 at = kind == "smaller" ? dvec3(.4, 0, .1) : dvec3(.1, 0, .1);
        scene.camera = camera_at({.3, .8, .2}, at, 25);
        proofs.push_back(sky_proof(
            fmt::format("coplanar/{}/half={:g}/{}/turn={}", kind, half, side_name(two_sided), turn),
            placed(std::move(scene), {rotation(turn)})));
        // After rotation, the corners of the large floor are rounded by up to .004, so that it may
        // pass above one half of the small one, and it is black from below.
        proofs.back().limit = kind == "smaller" && half >= 1e5 && turn != 0;
      }
    }
  }
}

/// Exact: the albedo, on top of a card; the spheres stay below it.
void cards_over_spheres(std::vector<Proof>& proofs) {
  for (const double half : {10.0, 1e3, 1e5}) {
    for (const double r : {.005, .02, .1, .5, 1.0}) {
      Scene scene = under_sky(true);
      scene.shapes = {level(half, 0), level(1, 2.1 * r), ball({.2, r, -.1}, r),
                      ball({2.5, r, 0}, r), ball({-.3, .9 * r, 1.5 + r}, r)};
      scene.camera = camera_at({.4, 2.1 * r + 1, .3}, {.1, 2.1 * r, 0}, 30);
      proofs.push_back(
          sky_proof(fmt::format("over_spheres/half={:g}/radius={:g}", half, r), scene));
    }
  }
}

void add_convex(Scene& scene, int kind) {
  if (kind == 0) scene.shapes = {ball({.37, -.2, .1}, 1)};
  if (kind == 1) add_box(scene, {{0, 0, 0}, {1, .7, .6}, rotation(7)}, {}, Facing::outwards);
  if (kind == 2) scene.shapes = {octahedron({0, 0, 0}, 1)};
  if (kind == 3) scene.shapes = {{carlo::Disk{{0, 0, 0}, {0, 0, 1}, 1}}};
  if (kind == 4) scene.shapes = {panel({0, 0, 0}, {1, 0, 0}, {.3, 1, 0})};
}

/// Exact: the albedo; convex. The film sees nothing else.
void convex_solids(std::vector<Proof>& proofs) {
  const char* const names[] = {"sphere", "box", "octahedron", "disk", "panel"};
  int number = 0;
  for (int kind = 0; kind < 5; ++kind) {
    for (const double scale : {1e-4, 1.0, 1e6}) {
      for (const double shift : {0.0, 1000.0}) {
        const bool two_sided = number % 2 == 0;
        Scene scene = under_sky(two_sided);
        add_convex(scene, kind);
        scene.camera = camera_at({.7, .9, 4}, {.1, .05, 0}, 8);
        const Placement placement{rotation(++number), scale, shift * dvec3(.6, -.5, .7)};
        proofs.push_back(sky_proof(fmt::format("convex/{}/scale={:g}/shift={:g}/{}", names[kind],
                                               scale, shift, side_name(two_sided)),
                                   placed(std::move(scene), placement)));
      }
    }
  }
}

}  // namespace

std::vector<Proof> sky_proofs() {
  std::vector<Proof> proofs;
  floors(proofs);
  floating_cards(proofs);
  slabs(proofs);
  coplanar_floors(proofs);
  cards_over_spheres(proofs);
  convex_solids(proofs);
  return proofs;
}

}  // namespace proving
