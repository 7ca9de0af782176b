#pragma once

#include "08_path_tracer/scenes.h"
#include "scene/scene.h"

#include <cmath>
#include <span>

// The worlds of lab 9's photon probes, which the checks use too.

namespace lab09_photons {

using carlo::Rgb;
using carlo::Vec3;
using lab08_tests::add_phong;

/// A light alone in the world: a tilted rectangle far from the origin, where no coordinate is
/// exact; a ball there; and a disc so small that any fixed distance is large beside it.
enum class PhotonLight { rectangle = 0, ball = 1, speck = 2 };

inline const Rgb light_radiance{1, 2, 4};
inline const carlo::Parallelogram light_rectangle{{37.3f, -21.7f, 55.1f},
                                                  2.0f * lab08_tests::tilted_frame().s,
                                                  0.75f * lab08_tests::tilted_frame().t};
inline const carlo::Sphere light_ball{{37.3f, -21.7f, 55.1f}, 0.7f};
inline const carlo::Disk light_speck{{0.01f, 0.02f, 0}, {0, 0, 1}, 1e-4f};

inline carlo::Scene lone_light(PhotonLight light) {
  carlo::Scene scene;
  const std::uint32_t black = add_phong(scene, Rgb(0));
  const auto emit = [&](auto geometry) {
    scene.shapes.push_back({geometry, black, light_radiance});
  };
  if (light == PhotonLight::rectangle) emit(light_rectangle);
  if (light == PhotonLight::ball) emit(light_ball);
  if (light == PhotonLight::speck) emit(light_speck);
  return scene;
}

/// Three squares that face up, the first from x = 0 on, the second from 10, the third from 20.
struct ColouredLight {
  float side;
  Rgb radiance;
};
inline constexpr ColouredLight coloured_lights[] = {
    {1, {4, 0, 0}}, {2, {0, 0.5f, 0}}, {0.5f, {0, 0, 16}}};
inline constexpr double light_step = 10;

inline carlo::Scene row_of(std::span<const ColouredLight> lights) {
  carlo::Scene scene;
  const std::uint32_t black = add_phong(scene, Rgb(0));
  float x = 0;
  for (const ColouredLight& light : lights) {
    scene.shapes.push_back({carlo::Parallelogram{{x, 0, 0}, {light.side, 0, 0}, {0, light.side, 0}},
                            black, light.radiance});
    x += static_cast<float>(light_step);
  }
  return scene;
}

/// Two squares that face up: a weak one from x = 0 on, and one of 1e8 times its power from 10 on.
inline constexpr ColouredLight weak_and_strong[] = {{1, {3, 2, 1}}, {100, {3e4f, 2e4f, 1e4f}}};

/// A black floor, z = 0, with a square light of side 1 that faces down at height 1, or without.
inline carlo::Scene landing_place(bool with_light) {
  carlo::Scene scene;
  const std::uint32_t black = add_phong(scene, Rgb(0));
  scene.shapes.push_back(
      {carlo::Parallelogram{{-50, -50, 0}, {100, 0, 0}, {0, 100, 0}}, black, Rgb(0)});
  if (with_light)
    scene.shapes.push_back({lab08_tests::facing_down(-0.5f, 0.5f), black, light_radiance});
  return scene;
}

/// Where photons are traced.
enum class PhotonPlace {
  closed = 0,   ///< in a diffuse sphere of radius 2 with albedos .6, .3 and .15
  mirrors = 1,  ///< between a grey floor, z = 0, and a mirror that faces it, z = 1
  glass = 2,    ///< a black ball in a ball of glass in a black sphere, radii .5, 1 and 3
  backs = 3,    ///< in front of a light (x = 1), and behind a one-sided white surface (x = -1)
  glossy = 4,   ///< on a glossy floor, in a black sphere of radius 10
  white = 5,    ///< in a sphere that absorbs nothing
  hall = 6      ///< in a sphere of lossless mirror
};

inline constexpr Rgb closed_albedo{0.6f, 0.3f, 0.15f};
inline constexpr Rgb mirror_reflectance{0.5f, 0.6f, 0.7f};
inline constexpr lab08_tests::PhongCase glossy_floor{0.3f, 0.6f, 50};
inline constexpr float glossy_degrees = 60;
inline constexpr Rgb sent_flux{2, 3, 5};

inline carlo::Scene photon_scene(PhotonPlace place) {
  carlo::Scene scene;
  const auto material = [&](auto model) {
    scene.materials.push_back({model, false});
    return static_cast<std::uint32_t>(scene.materials.size() - 1);
  };
  const auto diffuse = [&](Rgb kd) { return material(carlo::Phong{kd, Rgb(0), 0}); };
  const auto add = [&](auto geometry, std::uint32_t of, Rgb radiance = Rgb(0)) {
    scene.shapes.push_back({geometry, of, radiance});
  };
  const auto around = [](float radius) { return carlo::Sphere{{0, 0, 0}, radius, true}; };
  const carlo::Parallelogram floor{{-500, -500, 0}, {1000, 0, 0}, {0, 1000, 0}};
  switch (place) {
    case PhotonPlace::closed:
      add(around(2), diffuse(closed_albedo));
      break;
    case PhotonPlace::mirrors:
      add(floor, diffuse(Rgb(0.8f)));
      add(carlo::Parallelogram{{-500, -500, 1}, {0, 1000, 0}, {1000, 0, 0}},
          material(carlo::Mirror{mirror_reflectance}));
      break;
    case PhotonPlace::glass:
      add(carlo::Sphere{{0, 0, 0}, 0.5f}, diffuse(Rgb(0)));
      add(carlo::Sphere{{0, 0, 0}, 1}, material(carlo::Dielectric{1.5f, 1}));
      add(around(3), diffuse(Rgb(0)));
      break;
    case PhotonPlace::backs:
      add(carlo::Parallelogram{{1, -1, -1}, {0, 0, 2}, {0, 2, 0}}, diffuse(Rgb(0)), light_radiance);
      add(carlo::Parallelogram{{-1, -1, -1}, {0, 0, 2}, {0, 2, 0}}, diffuse(Rgb(0.9f)));
      break;
    case PhotonPlace::glossy:
      add(floor,
          material(carlo::Phong{Rgb(glossy_floor.kd), Rgb(glossy_floor.ks), glossy_floor.n}));
      add(around(10), diffuse(Rgb(0)));
      break;
    case PhotonPlace::white:
      add(around(2), diffuse(Rgb(1)));
      break;
    case PhotonPlace::hall:
      add(around(2), material(carlo::Mirror{Rgb(1)}));
      break;
  }
  return scene;
}

/// The ray of photon number i.
inline carlo::Ray sent_ray(PhotonPlace place, std::int64_t i) {
  const float turn = 2.3999632f * static_cast<float>(i % 512), c = std::cos(turn),
              s = std::sin(turn);
  switch (place) {
    case PhotonPlace::mirrors:
      return {{0, 0, 0.5f}, glm::normalize(Vec3(c, s, 2))};
    case PhotonPlace::glass:
      return {{0.3f * c, 0.3f * s, 2}, {0, 0, -1}};
    case PhotonPlace::backs:
      return {{0, 0.9f * c, 0.9f * s}, {i % 2 == 0 ? 1.0f : -1.0f, 0, 0}};
    case PhotonPlace::glossy: {
      const Vec3 wo = lab08_tests::direction_at(glossy_degrees, turn * 180 / 3.14159265f);
      return {wo, -wo};
    }
    default:
      return {{0.3f, 0, 0}, glm::normalize(Vec3(c, s, 0.5f * c))};
  }
}

}  // namespace lab09_photons
