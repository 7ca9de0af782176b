// A spot of a floor: small lights .3 above it with other shapes around, lights far away, many
// lights, covered light sources. Paths of two segments (max_depth 2) see only direct light, so that
// the shapes around may be white.

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

constexpr double light_albedo = .5;

Scene light_scene(double half, bool two_sided) {
  Scene scene = empty();
  scene.materials = {diffuse(Rgb(static_cast<float>(light_albedo)), two_sided),
                     diffuse(Rgb(0), false)};
  scene.shapes = {level(half, 0)};
  scene.camera = spot_camera();
  return scene;
}

/// Shapes that are neither between the spot and the light nor between the spot and the camera,
/// whose azimuth is that of (.6, .3).
void surround(Scene& scene) {
  for (int i = 0; i < 4; ++i) {
    const double azimuth = 1.5 + i;
    const dvec3 at(.7 * std::cos(azimuth), 0, .7 * std::sin(azimuth));
    scene.shapes.push_back(ball(at + dvec3(0, .05, 0), .05));
    add_box(scene, {.7 * at + dvec3(0, .03, 0), {.06, .02, .03}}, {}, Facing::outwards);
  }
  scene.shapes.push_back(level(.1, .01));
  std::get<carlo::Parallelogram>(scene.shapes.back().geometry).origin.x -= .4f;
}

/// Lights of half side or radius .05 at the height .3.
std::vector<Light> small_lights() {
  using namespace closed_forms;
  const float h = .3f, r = .05f;
  return {{"ball", ball({0, .3, 0}, .05), sphere_irradiance(6, 0)},
          {"disk", {carlo::Disk{{0, h, 0}, {0, -1, 0}, r}}, disk_irradiance(.05, .3, 0)},
          {"rectangle", panel({0, .3, 0}, {.05, 0, 0}, {0, 0, .05}),
           4 * rectangle_irradiance(.05 / .3, .05 / .3)}};
}

/// Exact: albedo E / pi at depth 2.
void lights_above_floors(std::vector<Proof>& proofs) {
  for (const double half : {1.0, 1e2, 1e3, 1e4, 1e5}) {
    for (const bool crowded : {false, true}) {
      for (const Light& light : small_lights()) {
        Scene scene = light_scene(half, crowded);
        scene.max_depth = 2;
        scene.shapes.push_back(lit(light.shape, 0, Rgb(100)));
        if (crowded) surround(scene);
        proofs.push_back(
            {fmt::format("lights/{}/half={:g}/{}", light.name, half, crowded ? "crowded" : "alone"),
             std::move(scene), exact_of(light_albedo * 100 * light.irradiance / closed_forms::pi)});
      }
    }
  }
}

/// Exact: albedo L A / (pi d^2) for a light of area (or great disk) A that shines down from far
/// away; radiance d^2. Its extent changes that by less than 1 / d^2.
void distant_lights(std::vector<Proof>& proofs) {
  for (const double d : {1e3, 1e4, 1e6}) {
    const auto y = static_cast<float>(d);
    const Light far[] = {{"ball", ball({0, d, 0}, 1), closed_forms::pi},
                         {"disk", {carlo::Disk{{0, y, 0}, {0, -1, 0}, 1}}, closed_forms::pi},
                         {"rectangle", panel({0, d, 0}, {1, 0, 0}, {0, 0, 1}), 4}};
    for (const Light& light : far) {
      for (const double half : {50.0, 1e4}) {
        Scene scene = light_scene(half, true);
        scene.shapes.push_back(lit(light.shape, 1, Rgb(y * y)));
        proofs.push_back({fmt::format("lights/distant/{}/d={:g}/half={:g}", light.name, d, half),
                          std::move(scene),
                          exact_of(light_albedo * light.irradiance / closed_forms::pi), 256});
      }
    }
  }
}

/// Exact: the sum over lights on a ring; they face the spot, roughly, and do not hide each other.
void rings(std::vector<Proof>& proofs) {
  for (const int count : {2, 5, 16}) {
    for (const double scale : {1e-3, 1.0, 1e5}) {
      Random random(static_cast<std::uint64_t>(count));
      Scene scene = light_scene(50, true);
      double sum = 0;
      for (int i = 0; i < count; ++i) {
        const double azimuth = 2 * closed_forms::pi * i / count, height = random.uniform(.9, 1.3);
        const dvec3 at(1.5 * std::cos(azimuth), height, 1.5 * std::sin(azimuth));
        const double d = glm::length(at), size = random.magnitude(.01, .15);
        const auto radiance = static_cast<float>(random.magnitude(1, 100));
        const dvec3 down = glm::normalize(-at + .5 * random.direction());
        const dvec3 a = size * glm::normalize(glm::cross(down, random.direction()));
        const dvec3 b = glm::cross(down, a);
        const bool round = i % 2 == 0;
        sum += static_cast<double>(radiance) *
               (round ? closed_forms::sphere_irradiance(d / size, std::acos(height / d))
                      : polygon_irradiance({at - a - b, at + a - b, at + a + b, at - a + b}));
        scene.shapes.push_back(lit(round ? ball(at, size) : panel(at, a, b), 1, Rgb(radiance)));
      }
      proofs.push_back({fmt::format("lights/ring/{}/scale={:g}", count, scale),
                        placed(std::move(scene), {rotation(count), scale}),
                        exact_of(light_albedo * sum / closed_forms::pi), 512});
    }
  }
}

/// Exact: 0. The light is 10 above the floor, the black cover below it twice as wide; past its edge
/// the light shines at a slope of at most `gap`, which misses the floor.
void covered_lights(std::vector<Proof>& proofs) {
  for (const double gap : {1e-1, 1e-2, 1e-3, 1e-4, 1e-5}) {
    for (const double scale : {1e-4, 1.0, 1e4}) {
      for (const bool point : {false, true}) {
        for (const bool turned : {false, true}) {
          Scene scene = light_scene(50, true);
          scene.shapes.push_back(panel({0, 10 - gap, 0}, {2, 0, 0}, {0, 0, 2}, {1}));
          if (point) scene.lights.points = {{{0, 10, 0}, Rgb(100)}};
          if (!point) scene.shapes.push_back(panel({0, 10, 0}, {1, 0, 0}, {0, 0, 1}, {1, Rgb(1)}));
          Proof proof{
              fmt::format("lights/covered {}/gap={:g}/scale={:g}/{}", point ? "point" : "rectangle",
                          gap, scale, turned ? "turned" : "straight"),
              placed(std::move(scene), {rotation(turned ? 15 : 0), scale}), exact_of(0), 64, 0};
          proof.limit = gap < 1e-4;  // coordinates of 10 are accurate to 5e-7, rotated ones to 2e-6
          proofs.push_back(std::move(proof));
        }
      }
    }
  }
}

}  // namespace

std::vector<Proof> light_proofs() {
  std::vector<Proof> proofs;
  lights_above_floors(proofs);
  distant_lights(proofs);
  rings(proofs);
  covered_lights(proofs);
  return proofs;
}

}  // namespace proving
