// A spot of a floor under one light: albedo / pi times the irradiance, which has a closed form for
// each of lights() (spots.cpp). The light is black, so that it reflects nothing back to the floor.

#include "closed_forms.h"
#include "proving/ground.h"
#include "proving/irradiance.h"
#include "proving/parts.h"
#include "proving/spots.h"

#include <fmt/core.h>

#include <cmath>
#include <string>
#include <utility>

namespace proving {
namespace {

using carlo::Rgb, carlo::Scene;
using glm::dvec3;

const Rgb spot_albedo(.75f, .5f, .25f);

/// The albedo times a factor.
std::array<double, 3> spot_radiance(double factor) {
  std::array<double, 3> exact = exact_of(spot_albedo);
  for (double& x : exact)
    x *= factor;
  return exact;
}

Scene spot_scene(double half, bool two_sided) {
  Scene scene = empty();
  scene.materials = {diffuse(spot_albedo, two_sided), diffuse(Rgb(0), false)};
  scene.shapes = {level(half, 0)};
  scene.camera = spot_camera();
  return scene;
}

/// Exact: albedo E / pi. Radiances do not change with scale.
void each_light(std::vector<Proof>& proofs) {
  struct Where {
    int turn;
    double shift;
  };
  int number = 0;
  for (const double scale : {1e-4, 1e-2, 1.0, 1e3, 1e6}) {
    for (const Where where : {Where{0, 0}, Where{1, 0}, Where{1, 1000}}) {
      for (const Light& light : lights()) {
        Scene scene = spot_scene(50, ++number % 2 == 0);
        scene.shapes.push_back(lit(light.shape, 1, Rgb(2)));
        const Placement placement{rotation(where.turn * number), scale,
                                  where.shift * dvec3(.5, -.7, .5)};
        proofs.push_back({fmt::format("spots/{}/scale={:g}/shift={:g}/{}", light.name, scale,
                                      where.shift, where.turn == 0 ? "straight" : "turned"),
                          placed(std::move(scene), placement),
                          spot_radiance(2 * light.irradiance / closed_forms::pi), 512,
                          spot_rounding(where.shift)});
      }
    }
  }
}

/// Exact: albedo I / (pi h^2), with the light directly above. Everything but the floor has size h.
void point_lights(std::vector<Proof>& proofs) {
  for (const double h : {1e-4, 1e-2, .3, 1.0, 1e3}) {
    for (const double half : {1.0, 50.0, 1e5}) {
      for (const bool turned : {false, true}) {
        Scene scene = spot_scene(half / h, true);
        scene.lights.points = {{{0, 1, 0}, Rgb(static_cast<float>(1 / (h * h)))}};
        if (half / h < 2) continue;  // the spot is .8 h from the camera; the floor must be larger
        Proof proof{fmt::format("spots/point/height={:g}/half={:g}/{}", h, half,
                                turned ? "turned" : "straight"),
                    placed(std::move(scene), {rotation(turned ? 13 : 0), h}),
                    spot_radiance(1 / (h * h * closed_forms::pi)), 64};
        // After rotation, a floor of half side 1e4 h is accurate to about 1e-3 h; otherwise to h
        // 2^-24.
        proof.limit = half / h > (turned ? 1e2 : 1e6);
        proofs.push_back(std::move(proof));
      }
    }
  }
}

/// Exact: albedo I cos / (pi d^2), in 3-4-5 triangles.
void slanted_points(std::vector<Proof>& proofs) {
  int number = 0;
  for (const double scale : {1e-4, 1.0, 1e4}) {
    for (const double shift : {0.0, 1000.0}) {
      for (const double d : {.1, 5.0, 1e3}) {
        Scene scene = spot_scene(50, ++number % 2 == 0);
        const dvec3 at = d * dvec3(-.6, .8, 0);
        scene.lights.points = {{carlo::Vec3(at), Rgb(static_cast<float>(d * d))}};
        // The spot must be small compared with d: 7e-5 is 7e-4 of .1.
        const Placement placement{rotation(number), scale, shift * dvec3(.5, -.7, .5)};
        proofs.push_back(
            {fmt::format("spots/slanted_point/d={:g}/scale={:g}/shift={:g}", d, scale, shift),
             placed(std::move(scene), placement), spot_radiance(.8 / closed_forms::pi), 64,
             spot_rounding(shift * (d < 1 ? 10 : 1)) + (d < 1 ? 1e-5 : 0)});
      }
    }
  }
}

/// Exact: the film sees the square [-1, 1]^2 from above, evenly, and the mean of h / r^3 over it is
/// a quarter of the square's solid angle from the light. So albedo I solid angle / (4 pi).
void films_under_points(std::vector<Proof>& proofs) {
  for (const double h : {.1, .3, 1.0}) {
    for (const double scale : {1e-4, 1.0, 1e6}) {
      Scene scene = spot_scene(50, true);
      scene.lights.points = {{{0, static_cast<float>(h), 0}, Rgb(3)}};
      scene.camera = camera_at({0, 2, 0}, {0, 0, 0}, 2 * 180 / closed_forms::pi * std::atan(.5));
      proofs.push_back({fmt::format("spots/film/height={:g}/scale={:g}", h, scale),
                        placed(std::move(scene), {rotation(14), scale}),
                        spot_radiance(3 * rectangle_solid_angle(1, 1, h) / (4 * closed_forms::pi)),
                        1024});
    }
  }
}

}  // namespace

std::vector<Proof> spot_proofs() {
  std::vector<Proof> proofs;
  each_light(proofs);
  point_lights(proofs);
  slanted_points(proofs);
  films_under_points(proofs);
  return proofs;
}

}  // namespace proving
