// Mirrors, glass and Phong's lobe where their radiance is known.

#include "closed_forms.h"
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

/// Exact: kd + ks a(n, theta), the lobe's albedo (closed_forms.h), for a card under a sky of 1; the
/// film sees 1e-4 of it, so that theta is constant.
void phong_cards(std::vector<Proof>& proofs) {
  constexpr double kd = .25, ks = .625;
  int number = 0;
  for (const int n : {0, 1, 5, 50, 1000, 100000}) {
    for (const double degrees : {0.0, 30.0, 60.0, 85.0}) {
      for (const bool two_sided : {false, true}) {
        const double theta = degrees * closed_forms::pi / 180;
        Scene scene = empty();
        scene.lights.environment = Rgb(1);
        scene.materials = {{carlo::Phong{Rgb(kd), Rgb(ks), static_cast<float>(n)}, two_sided}};
        scene.shapes = {level(two_sided ? 1 : 1e3, 0)};
        scene.camera = camera_at({std::sin(theta), std::cos(theta), 0}, {0, 0, 0}, .01);
        const double scale = std::array{1.0, 1e-4, 1e4}[static_cast<std::size_t>(number % 3)];
        proofs.push_back(
            {fmt::format("polished/phong/n={}/theta={:g}/{}", n, degrees,
                         two_sided ? "two-sided" : "one-sided"),
             placed(std::move(scene), {rotation(++number), scale}),
             exact_of(kd + ks * closed_forms::phong_albedo(n, theta)), 256,
             // The camera's direction is rounded: at 85 degrees, 1e-7 in angle is 1e-6 in cosine.
             2e-5});
      }
    }
  }
}

/// Exact: 1 through glass, r in a convex mirror, under a sky of 1; 1 again if the mirror emits 1 -
/// r.
void vanishing(std::vector<Proof>& proofs) {
  struct Kind {
    const char* name;
    carlo::Material material;
    float radiance;
    double exact;
  };
  const Kind kinds[] = {{"glass 1.1", {carlo::Dielectric{1.1f, 1}, false}, 0, 1},
                        {"glass 1.5", {carlo::Dielectric{1.5f, 1}, false}, 0, 1},
                        {"glass 2.4", {carlo::Dielectric{2.4f, 1}, false}, 0, 1},
                        {"bubble", {carlo::Dielectric{1, 1.33f}, false}, 0, 1},
                        {"mirror 1", {carlo::Mirror{Rgb(1)}, false}, 0, 1},
                        {"mirror .25", {carlo::Mirror{Rgb(.25f)}, false}, 0, .25},
                        {"shining mirror", {carlo::Mirror{Rgb(.25f)}, false}, .75f, 1}};
  for (const Kind& kind : kinds) {
    // The last one's top lies in the plane y = 0: there a point's height is nothing but rounding.
    for (const std::string shape : {"ball", "box", "box below 0"}) {
      for (const double scale : {1e-4, 1.0, 1e5}) {
        Scene scene = empty();
        scene.lights.environment = Rgb(1);
        scene.materials = {kind.material};
        const Finish finish{0, Rgb(kind.radiance)};
        scene.camera = camera_at({.7, .9, 4}, {.05, .02, 0}, 8);
        if (shape == "ball") {
          scene.shapes = {ball({0, 0, 0}, 1, finish)};
        } else if (shape == "box") {
          add_box(scene, {{0, 0, 0}, {1, .7, .6}, rotation(51)}, finish, Facing::outwards);
        } else {
          const double c = std::sqrt(.5);
          add_box(scene, {{0, -.5, 0}, dvec3(.5), {c, 0, -c, 0, 1, 0, c, 0, c}}, finish,
                  Facing::outwards);
          scene.camera = camera_at({.3, .5, -3}, {0, -.4, 0}, 12);
        }
        proofs.push_back(
            {fmt::format("polished/{}/{}/scale={:g}", kind.name, shape, scale),
             placed(std::move(scene), {rotation(shape == "box below 0" ? 0 : 52), scale}),
             exact_of(kind.exact), 256});
      }
    }
  }
}

/// Exact: the product of the two reflectances; with paths of less than three segments, 0. The
/// camera looks along -z into a mirror, up into another, then along -z again at a light.
void periscopes(std::vector<Proof>& proofs) {
  const dvec3 x(1, 0, 0), slope(0, 1, -1);
  for (const float r : {1.0f, .5f}) {
    for (const int depth : {0, 2, 3}) {
      for (const double scale : {1e-4, 1.0, 1e5}) {
        Scene scene = empty();
        scene.max_depth = depth;
        scene.materials = {{carlo::Mirror{Rgb(.5f, .25f, 1)}, true},
                           {carlo::Mirror{Rgb(r)}, true},
                           diffuse(Rgb(0), false)};
        scene.shapes = {panel({0, 0, -3}, x, slope, {0}), panel({0, 5, -3}, x, slope, {1}),
                        panel({0, 5, -10}, 3.0 * x, {0, 3, 0}, {2, Rgb(1)})};
        scene.camera = camera_at({0, 0, 0}, {0, 0, -3}, 5);
        Proof proof{fmt::format("polished/periscope/r={:g}/depth={}/scale={:g}", r, depth, scale),
                    placed(std::move(scene), {rotation(53), scale}),
                    exact_of(r * Rgb(.5f, .25f, 1)), 128};
        if (depth == 2) proof.exact = exact_of(0), proof.rounding = 0;
        proofs.push_back(std::move(proof));
      }
    }
  }
}

}  // namespace

std::vector<Proof> polished_proofs() {
  std::vector<Proof> proofs;
  phong_cards(proofs);
  vanishing(proofs);
  periscopes(proofs);
  return proofs;
}

}  // namespace proving
