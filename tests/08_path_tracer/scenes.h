#pragma once

#include "08_path_tracer/places.h"
#include "scene/scene.h"

#include <cmath>
#include <variant>

// The worlds of lab 8's probes; each has a closed form (theory.h).

namespace lab08_tests {

using carlo::Rgb;
using carlo::Vec3;

inline std::uint32_t add_phong(carlo::Scene& scene, Rgb kd, Rgb ks = Rgb(0), float n = 0) {
  scene.materials.push_back({carlo::Phong{kd, ks, n}, false});
  return static_cast<std::uint32_t>(scene.materials.size() - 1);
}

/// Lights over the point (0, 0, 0) of a floor with normal +z. The world of `disk` is moved as a
/// whole, see pose_of().
enum class Light {
  rectangle = 0,  ///< the unit square, centred at height 1, facing down
  disk = 1,       ///< radius 1, centred at height 1, facing down
  sphere = 2,     ///< radius 1, centre at distance 2, 50 degrees from the normal
  wall = 3,       ///< the unit square standing at distance 1, its lower edge on the floor
  two = 4,        ///< two halves of `rectangle`: one is red, radiance 1, the other green, 3;
                  ///< the floor glows in blue
  covered = 5,    ///< `rectangle`, half of it behind a black screen
  behind = 6,     ///< `rectangle`, facing up, over a floor that emits, under a sky
  none = 7,       ///< no light but a sky
  weak = 8,       ///< `near_light` and `far_sun`, with 2e9 times its power: irradiance 3 each
  count = 9
};

inline const char* name_of(Light light) {
  constexpr const char* names[] = {"a square light",
                                   "a round light, the floor tilted",
                                   "a ball of light",
                                   "a shining wall",
                                   "two lights",
                                   "a light half hidden",
                                   "a light that faces away, and a sky",
                                   "a sky",
                                   "a weak light and a far sun"};
  return names[static_cast<int>(light)];
}

/// Balls of light whose irradiance is pi radiance (radius/distance)^2 times the cosine, 3 for both.
/// The sun is overhead, and the light not in its way.
struct LitBall {
  carlo::Sphere ball;
  float radiance;
};
inline const LitBall near_light{{{0.6f, 0, 0.8f}, 0.1f}, 3 / (3.14159265f * 0.008f)};
inline const LitBall far_sun{{{0, 0, 1e5f}, 1e3f}, 3 / (3.14159265f * 1e-4f)};

/// The emission of glowing floors and of skies: estimates of direct light must not contain it.
constexpr float floor_glow = 16, sky_glow = 3;

/// Tilted, and far from the origin: there no coordinate of a point of the floor is exact, and rays
/// that start on it would meet it again, from about half of its points.
struct Pose {
  Frame3 frame{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  Vec3 origin{0};
  Vec3 direction(Vec3 v) const { return v.x * frame.s + v.y * frame.t + v.z * frame.n; }
  Vec3 point(Vec3 v) const { return origin + direction(v); }
};

inline Pose pose_of(Light light) {
  if (light != Light::disk) return {};
  return {tilted_frame(), {37.3f, -21.7f, 55.1f}};
}

inline void move(carlo::Scene& scene, const Pose& pose) {
  for (carlo::Shape& shape : scene.shapes) {
    if (auto* disk = std::get_if<carlo::Disk>(&shape.geometry)) {
      *disk = {pose.point(disk->center), pose.direction(disk->normal), disk->radius};
    } else if (auto* quad = std::get_if<carlo::Parallelogram>(&shape.geometry)) {
      *quad = {pose.point(quad->origin), pose.direction(quad->u), pose.direction(quad->v)};
    }
  }
}

inline carlo::Parallelogram facing_down(float x0, float x1) {
  return {Vec3(x0, 0.5f, 1), Vec3(x1 - x0, 0, 0), Vec3(0, -1, 0)};
}

inline carlo::Scene light_scene(Light light) {
  carlo::Scene scene;
  const std::uint32_t grey = add_phong(scene, Rgb(0.5f)), black = add_phong(scene, Rgb(0));
  scene.shapes.push_back(
      {carlo::Parallelogram{{-50, -50, 0}, {100, 0, 0}, {0, 100, 0}}, grey, Rgb(0)});
  const auto emit = [&](auto geometry, Rgb radiance) {
    scene.shapes.push_back({geometry, black, radiance});
  };
  constexpr float half_turn = 3.14159265f;
  const float angle = half_turn * 50 / 180;
  switch (light) {
    case Light::rectangle:
      emit(facing_down(-0.5f, 0.5f), Rgb(1, 2, 4));
      break;
    case Light::disk:
      emit(carlo::Disk{{0, 0, 1}, {0, 0, -1}, 1}, Rgb(1, 2, 4));
      break;
    case Light::sphere:
      emit(carlo::Sphere{{2 * std::sin(angle), 0, 2 * std::cos(angle)}, 1}, Rgb(1, 2, 4));
      break;
    case Light::wall:
      emit(carlo::Parallelogram{{1, 0, 0}, {0, 0, 1}, {0, 1, 0}}, Rgb(1, 2, 4));
      break;
    case Light::two:
      emit(facing_down(-0.5f, 0), Rgb(1, 0, 0));
      emit(facing_down(0, 0.5f), Rgb(0, 3, 0));
      scene.shapes[0].radiance = Rgb(0, 0, floor_glow);
      break;
    case Light::covered:
      emit(facing_down(-0.5f, 0.5f), Rgb(1, 2, 4));
      scene.shapes.push_back(
          {carlo::Parallelogram{{0, -2, 0.999f}, {2, 0, 0}, {0, 4, 0}}, black, Rgb(0)});
      break;
    case Light::behind:
      emit(carlo::Parallelogram{{-0.5f, -0.5f, 1}, {1, 0, 0}, {0, 1, 0}}, Rgb(1, 2, 4));
      scene.shapes[0].radiance = Rgb(floor_glow);
      scene.lights.environment = Rgb(sky_glow);
      break;
    case Light::none:
      scene.lights.environment = Rgb(sky_glow);
      break;
    case Light::weak:
      // Green comes from the light alone, blue from the sun.
      emit(near_light.ball, near_light.radiance * Rgb(1, 1, 0));
      emit(far_sun.ball, far_sun.radiance * Rgb(1, 0, 1));
      break;
    case Light::count:
      break;
  }
  if (light == Light::disk) move(scene, pose_of(light));
  return scene;
}

/// Seen from inside: a sphere of radius 2 that emits 1 everywhere, albedo `rho` in each channel.
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

/// A black furnace with a ball of mirror at its centre, of radius .5.
inline carlo::Scene furnace_with_mirror(Rgb reflectance) {
  carlo::Scene scene = furnace(Rgb(0));
  scene.materials.push_back({carlo::Mirror{reflectance}, false});
  scene.shapes.push_back({carlo::Sphere{{0, 0, 0}, 0.5f}, 1, Rgb(0)});
  return scene;
}

/// The unit square, centred at height 1, facing down, of radiance 1, with a screen in front: the
/// point (0, 0, 0) of the floor sees it only through the screen.
inline carlo::Scene screened_light(carlo::Material screen) {
  carlo::Scene scene = light_scene(Light::rectangle);
  scene.shapes[1].radiance = Rgb(1);
  scene.materials.push_back(screen);
  scene.shapes.push_back(
      {carlo::Parallelogram{{-0.12f, -0.12f, 0.2f}, {0.24f, 0, 0}, {0, 0.24f, 0}}, 2, Rgb(0)});
  return scene;
}

/// The screen is glass as thin as air: light goes straight through.
inline carlo::Scene light_behind_pane() {
  return screened_light({carlo::Dielectric{1, 1}, false});
}

/// The distance of the mirror of mirrored_light() from the point (0, 0, 0) of the floor.
constexpr float mirror_distance = 0.6f;

/// The screen is black; (0, 0, 0) sees the whole light in a lossless mirror beside it.
inline carlo::Scene mirrored_light() {
  carlo::Scene scene = screened_light({carlo::Phong{Rgb(0), Rgb(0), 0}, false});
  scene.materials.push_back({carlo::Mirror{Rgb(1)}, false});
  scene.shapes.push_back(
      {carlo::Parallelogram{{mirror_distance, -1, 0}, {0, 0, 2}, {0, 2, 0}}, 3, Rgb(0)});
  return scene;
}

/// A unit sphere under a sky of radiance 1.
inline carlo::Scene ball(carlo::Material material) {
  carlo::Scene scene;
  scene.materials.push_back(material);
  scene.shapes.push_back({carlo::Sphere{{0, 0, 0}, 1}, 0, Rgb(0)});
  scene.lights.environment = Rgb(1);
  return scene;
}

/// A ray that meets the unit ball where its normal is +z, at this angle from it.
inline carlo::Ray towards_pole(float degrees) {
  const float angle = degrees * 3.14159265f / 180;
  const Vec3 wo(std::sin(angle), 0, std::cos(angle));
  return {Vec3(0, 0, 1) + 3.0f * wo, -wo};
}

}  // namespace lab08_tests
