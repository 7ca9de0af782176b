// A closed furnace (ground_furnaces.cpp) with objects inside. Objects that emit E and reflect rho
// like the walls, reflect everything, or transmit everything leave L = E / (1 - rho) in every
// direction: glass multiplies radiance by eta^2 on the way in and divides by it on the way out.

#include "proving/ground.h"
#include "proving/parts.h"

#include <fmt/core.h>

#include <cmath>
#include <string>
#include <utility>

namespace proving {
namespace {

using carlo::Rgb, carlo::Scene;
using glm::dvec3;

enum Content : int {
  box_inside,
  slab_inside,
  ball_inside,
  many_balls,
  nested_shell,
  mirror_ball,
  mirror_card,
  glass_ball,
  glass_slab,
  bubble
};
const char* const content_names[] = {"box",        "slab",        "ball",        "balls",
                                     "shell",      "mirror_ball", "mirror_card", "glass_ball",
                                     "glass_slab", "bubble"};

/// Adds an object around (.2, .1, -.1), no larger than .5; material 0 with its emission is that of
/// the walls, 1 is a mirror, 2 glass, 3 air inside glass.
void add_content(Scene& scene, Content content, const Finish& wall) {
  const dvec3 c(.2, .1, -.1);
  switch (content) {
    case box_inside:
      return add_box(scene, {c, {.3, .2, .25}, rotation(21)}, wall, Facing::outwards);
    case slab_inside:
      return add_box(scene, {c, {.4, .0005, .3}, rotation(22)}, wall, Facing::outwards);
    case ball_inside:
      return scene.shapes.push_back(ball(c, .4, wall));
    case many_balls:
      for (int i = 0; i < 8; ++i) {
        const dvec3 at(i & 1 ? .25 : -.25, i & 2 ? .25 : -.25, i & 4 ? .25 : -.25);
        scene.shapes.push_back(ball(c + at, .25, wall));  // they touch
      }
      return;
    case nested_shell:
      return scene.shapes.push_back(ball({.1, 0, 0}, 1.3, wall));  // its room has no space for a
                                                                   // box
    case mirror_ball:
      return scene.shapes.push_back(ball(c, .4, {1}));
    case mirror_card:
      return scene.shapes.push_back(panel(c, {.3, .1, 0}, {0, .2, .3}, {1}));
    case glass_ball:
      return scene.shapes.push_back(ball(c, .4, {2}));
    case glass_slab:
      return add_box(scene, {c, {.4, .05, .3}, rotation(23)}, {2}, Facing::outwards);
    case bubble:
      scene.shapes.push_back(ball(c, .4, {2}));
      scene.shapes.push_back(ball(c, .3, {3}));
  }
}

Scene furnished(Content content, float rho, bool two_sided, int depth) {
  Scene scene = empty();
  scene.max_depth = depth;
  scene.materials = {diffuse(Rgb(rho), two_sided),
                     {carlo::Mirror{Rgb(1)}, true},
                     {carlo::Dielectric{1.5f, 1}, false},
                     {carlo::Dielectric{1, 1.5f}, false}};
  const Finish wall{0, Rgb(1)};
  if (content == nested_shell) {
    scene.shapes = {ball({0, 0, 0}, 1.5, wall, Facing::inwards)};
    scene.camera = camera_at({-.9, 1.1, .1}, {1, 1, .3}, 90);
  } else {
    add_box(scene, {dvec3(0), dvec3(1), glm::dmat3(1), .02}, wall, Facing::inwards);
    scene.camera = camera_at({-.6, -.5, .7}, {.2, .1, -.1}, 70);
  }
  add_content(scene, content, wall);
  return scene;
}

void unlimited(std::vector<Proof>& proofs) {
  for (int content = box_inside; content <= bubble; ++content) {
    for (const float rho : {.25f, .5f, .875f}) {
      for (const int turn : {0, 9}) {
        // A one-sided ball or box is black inside, where no path may get.
        const bool two_sided = turn == 0 && content < nested_shell;
        Scene scene = furnished(static_cast<Content>(content), rho, two_sided, 0);
        const double scale = turn == 0 ? 1 : 1e3;
        proofs.push_back({fmt::format("furnished/{}/rho={:g}/{}/turn={}", content_names[content],
                                      rho, two_sided ? "two-sided" : "one-sided", turn),
                          placed(std::move(scene), {rotation(turn), scale}),
                          exact_of(1 / (1 - static_cast<double>(rho))), 256});
      }
    }
  }
}

/// Exact: 1 + rho + ... + rho^(K-1), for objects that emit and reflect like the walls.
void limited_depth(std::vector<Proof>& proofs) {
  for (int content = box_inside; content <= nested_shell; ++content) {
    for (const int depth : {2, 4}) {
      Scene scene = furnished(static_cast<Content>(content), .5f, false, depth);
      proofs.push_back({fmt::format("furnished/{}/depth={}", content_names[content], depth),
                        placed(std::move(scene), {rotation(10)}),
                        exact_of(2 * (1 - std::pow(.5, depth))), 256});
    }
  }
}

}  // namespace

std::vector<Proof> furnished_furnace_proofs() {
  std::vector<Proof> proofs;
  unlimited(proofs);
  limited_depth(proofs);
  return proofs;
}

}  // namespace proving
