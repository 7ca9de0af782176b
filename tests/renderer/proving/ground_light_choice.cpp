// Scenes in which the brightest light is not the one to sample: light sources near the camera under
// images of a sky, in scenes that a stray shape makes large; lights in a Phong lobe beside stronger
// ones outside it.

#include "closed_forms.h"
#include "proving/ground.h"
#include "proving/lights_of_all_kinds.h"
#include "proving/parts.h"
#include "proving/spots.h"

#include <fmt/core.h>

#include <cmath>
#include <string>
#include <utility>

namespace proving {
namespace {

using carlo::Rgb, carlo::Scene, carlo::Vec3;
using closed_forms::pi;
using glm::dvec3;

constexpr double floor_albedo = .5;

enum class Sky { whole, half, upper };

/// Radiance 1 everywhere; only in one half of the azimuths; or only above the horizon.
carlo::Envmap sky_of(Sky sky) {
  if (sky == Sky::half) return image_of([](int column, int) { return Rgb(column < 4 ? 1 : 0); });
  if (sky == Sky::upper) return image_of([](int, int row) { return Rgb(row < 2 ? 1 : 0); });
  return image_of([](int, int) { return Rgb(1); });
}

/// Exact: albedo / pi (E + I / h^2), E = pi or pi / 2, with the light directly above. A black stray
/// panel at distance `far` covers at most 1e-6 of the hemisphere.
void lights_under_skies(std::vector<Proof>& proofs) {
  int number = 0;
  for (const double half : {1.0, 1e2, 1e4}) {
    for (const double far : {0.0, 1e3, 1e6, 1e9}) {
      for (const Sky sky : {Sky::whole, Sky::half, Sky::upper}) {
        for (const double height : {1.0, 1e-2}) {
          Scene scene = empty();
          scene.materials = {diffuse(Rgb(floor_albedo), true), diffuse(Rgb(0), true)};
          scene.shapes = {level(half, 0)};
          scene.camera = spot_camera();
          scene.max_depth = 2;
          scene.lights.envmap = sky_of(sky);
          const double of_light = 10;
          scene.lights.points = {{{0, static_cast<float>(height), 0},
                                  Rgb(static_cast<float>(of_light * height * height))}};
          // Below the floor, where only the sky sees it.
          if (far > 0)
            scene.shapes.push_back(panel({far, -.5 * far, far}, {.1, 0, 0}, {0, 0, .1}, {1}));
          const double of_sky = sky == Sky::half ? pi / 2 : pi;
          Proof proof{fmt::format("skies/{}/half={:g}/stray={:g}/height={:g}",
                                  sky == Sky::whole  ? "whole"
                                  : sky == Sky::half ? "half"
                                                     : "upper",
                                  half, far, height),
                      placed(std::move(scene), {rotation(half < 1e3 ? ++number % 3 : 0)}),
                      exact_of(floor_albedo / pi * (of_sky + of_light)), 512};
          // The film sees 7e-5 to either side: of a light at .01 that is 1e-4 of its irradiance.
          proof.rounding = height < 1 ? 2e-4 : 1e-5;
          proofs.push_back(std::move(proof));
        }
      }
    }
  }
}

/// The light in the lobe.
enum class InLobe { disk, ball, point };

/// Exact: in the lobe, for a cone light about its axis, 1 - cos^(n+2) of the half-angle; or for a
/// point light, (n+2) / (2 pi) I / d^2. Outside it, at 60 degrees, a point light with `ratio` times
/// the irradiance: (n+2) / (2 pi) cos^n 60 E.
void lights_in_lobes(std::vector<Proof>& proofs) {
  int number = 0;
  for (const int n : {100, 1000, 10000}) {
    for (const InLobe in : {InLobe::disk, InLobe::ball, InLobe::point}) {
      for (const double ratio : {1.0, 1e4, 1e8, 1e12}) {
        Scene scene = empty();
        scene.materials = {{carlo::Phong{Rgb(0), Rgb(1), static_cast<float>(n)}, number % 2 == 0},
                           diffuse(Rgb(0), true)};
        scene.shapes = {level(50, 0)};
        scene.camera = camera_at({0, 1, 0}, {0, 0, 0}, .01);
        scene.max_depth = 2;
        const double angle = 1.2 / std::sqrt(n), lobe = (n + 2) / (2 * pi), distance = 2;
        const double sine = std::sin(angle), covers = pi * sine * sine;
        double exact = -std::expm1((n + 2) * std::log(std::cos(angle)));
        if (in == InLobe::ball)
          scene.shapes.push_back(ball({0, distance, 0}, distance * sine, {1, Rgb(1)}));
        if (in == InLobe::disk)
          scene.shapes.push_back(
              {carlo::Disk{
                   {0, distance, 0}, {0, -1, 0}, static_cast<float>(distance * std::tan(angle))},
               1, Rgb(1)});
        if (in == InLobe::point) {
          const auto intensity = static_cast<float>(covers * distance * distance);
          scene.lights.points = {{{0, distance, 0}, Rgb(intensity)}};
          exact = lobe * covers;
        }
        const double strong = ratio * covers;
        scene.lights.points.push_back(
            {{-2 * std::sqrt(.75f), 1, 0}, Rgb(static_cast<float>(strong * 4 / .5))});
        exact += lobe * std::pow(.5, n) * strong;
        Proof proof{fmt::format("lobes/{}/n={}/ratio={:g}",
                                in == InLobe::disk   ? "disk"
                                : in == InLobe::ball ? "ball"
                                                     : "point",
                                n, ratio),
                    placed(std::move(scene), {rotation(++number % 2), 1}), exact_of(exact),
                    in == InLobe::point ? 2304U : 1024U};
        // Over the film, 9e-5 to either side, cos^n changes by n 5e-9; disks lose an amount
        // proportional to n.
        proof.rounding = 2e-5 + 2e-8 * n;
        proofs.push_back(std::move(proof));
      }
    }
  }
}

}  // namespace

std::vector<Proof> light_choice_proofs() {
  std::vector<Proof> proofs;
  lights_under_skies(proofs);
  lights_in_lobes(proofs);
  return proofs;
}

}  // namespace proving
