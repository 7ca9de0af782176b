#pragma once

#include "scene/scene.h"

#include <cmath>

// The worlds that lab 08's probes build; each has a closed form (theory.h).

namespace lab08_tests {

using carlo::Rgb;
using carlo::Vec3;

inline std::uint32_t add_phong(carlo::Scene& scene, Rgb kd, Rgb ks = Rgb(0), float n = 0) {
  scene.materials.push_back({carlo::Phong{kd, ks, n}, false});
  return static_cast<std::uint32_t>(scene.materials.size() - 1);
}

/// Lights over the point (0, 0, 0) of a floor whose normal is +z.
enum class Lamp {
  rectangle = 0,  ///< the unit square, centred at height 1, facing down
  disk = 1,       ///< radius 1, centred at height 1, facing down
  sphere = 2,     ///< radius 1, centre at distance 2, 50 degrees from the normal
  wall = 3,       ///< the unit square standing at distance 1, its lower edge on the floor
  two = 4,        ///< two halves of `rectangle`, radiances 1 and 3
  covered = 5,    ///< `rectangle`, half of it behind a black screen
  behind = 6,     ///< `rectangle`, facing up
  none = 7,
  count = 8
};

inline carlo::Parallelogram facing_down(float x0, float x1) {
  return {Vec3(x0, 0.5f, 1), Vec3(x1 - x0, 0, 0), Vec3(0, -1, 0)};
}

inline carlo::Scene lamp_scene(Lamp lamp) {
  carlo::Scene scene;
  const std::uint32_t grey = add_phong(scene, Rgb(0.5f)), black = add_phong(scene, Rgb(0));
  scene.shapes.push_back(
      {carlo::Parallelogram{{-50, -50, 0}, {100, 0, 0}, {0, 100, 0}}, grey, Rgb(0)});
  const auto emit = [&](auto geometry, Rgb radiance) {
    scene.shapes.push_back({geometry, black, radiance});
  };
  constexpr float half_turn = 3.14159265f;
  const float angle = half_turn * 50 / 180;
  switch (lamp) {
    case Lamp::rectangle:
      emit(facing_down(-0.5f, 0.5f), Rgb(1, 2, 4));
      break;
    case Lamp::disk:
      emit(carlo::Disk{{0, 0, 1}, {0, 0, -1}, 1}, Rgb(1, 2, 4));
      break;
    case Lamp::sphere:
      emit(carlo::Sphere{{2 * std::sin(angle), 0, 2 * std::cos(angle)}, 1}, Rgb(1, 2, 4));
      break;
    case Lamp::wall:
      emit(carlo::Parallelogram{{1, 0, 0}, {0, 0, 1}, {0, 1, 0}}, Rgb(1, 2, 4));
      break;
    case Lamp::two:
      emit(facing_down(-0.5f, 0), Rgb(1));
      emit(facing_down(0, 0.5f), Rgb(3));
      break;
    case Lamp::covered:
      emit(facing_down(-0.5f, 0.5f), Rgb(1, 2, 4));
      scene.shapes.push_back(
          {carlo::Parallelogram{{0, -2, 0.999f}, {2, 0, 0}, {0, 4, 0}}, black, Rgb(0)});
      break;
    case Lamp::behind:
      emit(carlo::Parallelogram{{-0.5f, -0.5f, 1}, {1, 0, 0}, {0, 1, 0}}, Rgb(1, 2, 4));
      break;
    case Lamp::none:
    case Lamp::count:
      break;
  }
  return scene;
}

/// Seen from its inside: a sphere of radius 2 that emits 1 everywhere, albedo `rho` in each
/// channel.
inline carlo::Scene furnace(Rgb rho, float radius = 2) {
  carlo::Scene scene;
  scene.shapes.push_back({carlo::Sphere{{0, 0, 0}, radius, true}, add_phong(scene, rho), Rgb(1)});
  return scene;
}

/// The same with a ball of glass of radius .5 at its centre.
inline carlo::Scene furnace_with_glass(Rgb rho) {
  carlo::Scene scene = furnace(rho);
  scene.materials.push_back({carlo::Dielectric{1.5f, 1}, false});
  scene.shapes.push_back({carlo::Sphere{{0, 0, 0}, 0.5f}, 1, Rgb(0)});
  return scene;
}

/// A unit sphere under a sky of radiance 1.
inline carlo::Scene ball(carlo::Material material) {
  carlo::Scene scene;
  scene.materials.push_back(material);
  scene.shapes.push_back({carlo::Sphere{{0, 0, 0}, 1}, 0, Rgb(0)});
  scene.environment = Rgb(1);
  return scene;
}

/// A ray that meets the unit ball where its normal is +z, at this angle from it.
inline carlo::Ray towards_pole(float degrees) {
  const float angle = degrees * 3.14159265f / 180;
  const Vec3 wo(std::sin(angle), 0, std::cos(angle));
  return {Vec3(0, 0, 1) + 3.0f * wo, -wo};
}

}  // namespace lab08_tests
