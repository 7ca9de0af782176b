#pragma once

#include "08_path_tracer/scenes.h"
#include "09_bias/density_data.h"
#include "scene/camera.h"
#include "scene/scene.h"

// The worlds in which Lab 9.5's probes follow rays, which the checks use too.

namespace lab09_density {

/// How a ray reaches a small round target at the origin that faces up, or misses it. No light
/// returns from the target to itself.
enum class Sight {
  straight = 0,
  mirror = 1,   ///< by a mirror
  mirrors = 2,  ///< by two mirrors
  glass = 3,    ///< through the surface of glass, below which the target lies
  sky = 4,      ///< misses, under a sky
  mirrored_sky = 5,
  count = 6
};

inline const char* name_of(Sight sight) {
  constexpr const char* names[] = {
      "seen straight", "seen in a mirror", "seen in two mirrors", "seen from outside of glass",
      "a sky",         "a sky in a mirror"};
  return names[static_cast<int>(sight)];
}

inline const carlo::Phong target_phong{{0.3f, 0.2f, 0.1f}, Rgb(0.5f), 5};
inline const Rgb target_glow{0.1f, 0.2f, 0.4f}, sky{0.5f, 3, 2};
inline const Rgb first_mirror{0.5f, 0.6f, 0.7f}, second_mirror{0.9f, 0.8f, 0.4f};
inline constexpr float glass_index = 1.5f, target_radius = 0.05f;
inline constexpr int target_photons = 16;

/// The point in glass from which the target is seen, and how a ray gets there from outside.
inline const Vec3 glass_place{-0.5f, 0, 1};
inline Vec3 above_glass() {
  const float sine = glass_index * 0.5f / std::sqrt(1.25f);
  return {-sine, 0, std::sqrt(1 - sine * sine)};
}

inline carlo::Ray sight_ray(Sight sight) {
  const Vec3 slanted = glm::normalize(Vec3(1, 2, 3));
  switch (sight) {
    case Sight::straight:
      return {slanted, -slanted};
    case Sight::mirror:
    case Sight::mirrored_sky:
      return {{-3, 0, 2}, {1, 0, 0}};
    case Sight::mirrors:
      return {{-2, 0, 5}, {0, 0, -1}};
    case Sight::glass:
      return {glass_place + 2.0f * above_glass(), -above_glass()};
    default:
      return {{0, 0, 3}, slanted};
  }
}

/// The direction in which the target is seen.
inline Vec3 target_wo(Sight sight) {
  if (sight == Sight::straight) return glm::normalize(Vec3(1, 2, 3));
  return sight == Sight::glass ? glm::normalize(glass_place) : Vec3(0, 0, 1);
}

inline carlo::Scene sight_scene(Sight sight) {
  carlo::Scene scene;
  const auto add = [&](auto geometry, auto model, Rgb radiance = Rgb(0)) {
    scene.materials.push_back({model, false});
    scene.shapes.push_back(
        {geometry, static_cast<std::uint32_t>(scene.materials.size() - 1), radiance});
  };
  const bool under_sky = sight == Sight::sky || sight == Sight::mirrored_sky;
  if (under_sky) {
    scene.lights.environment = sky;
  } else {
    add(carlo::Disk{{0, 0, 0}, {0, 0, 1}, 2 * target_radius}, target_phong, target_glow);
  }
  const float half = std::sqrt(0.5f);
  const bool mirrored = sight == Sight::mirror || sight == Sight::mirrors;
  if (mirrored || under_sky)
    add(carlo::Disk{{0, 0, 2}, {-half, 0, -half}, 0.05f}, carlo::Mirror{first_mirror});
  if (sight == Sight::mirrors)
    add(carlo::Disk{{-2, 0, 2}, {half, 0, half}, 0.05f}, carlo::Mirror{second_mirror});
  if (sight == Sight::glass)
    add(carlo::Disk{glass_place, {0, 0, 1}, 0.05f}, carlo::Dielectric{glass_index, 1});
  return scene;
}

/// A white ball under a sky of constant radiance; bare, or inside a ball of glass.
inline carlo::Scene white_ball_scene(bool in_glass) {
  carlo::Scene scene;
  scene.lights.environment = sky;
  const std::uint32_t white = lab08_tests::add_phong(scene, Rgb(1));
  scene.shapes.push_back({carlo::Sphere{{0, 0, 0}, 0.5f}, white, Rgb(0)});
  if (!in_glass) return scene;
  scene.materials.push_back({carlo::Dielectric{glass_index, 1}, false});
  scene.shapes.push_back({carlo::Sphere{{0, 0, 0}, 1}, 1, Rgb(0)});
  return scene;
}

/// A ball of mirror in a sphere that emits red and reflects. A few photons, all of which serve
/// everywhere, carry only green: of each pair, with opposite directions, one counts.
inline constexpr float wall_albedo = 0.6f, ball_reflectance = 0.8f, ball_radius = 0.4f,
                       wall_glow = 1, everywhere = 3;
inline constexpr float pair_flux = 15;  ///< of each photon
inline constexpr int photon_pairs = 3;

inline carlo::Scene ball_in_sphere() {
  carlo::Scene scene;
  const std::uint32_t wall = lab08_tests::add_phong(scene, Rgb(wall_albedo));
  scene.shapes.push_back({carlo::Sphere{{0, 0, 0}, 1, true}, wall, {wall_glow, 0, 0}});
  scene.materials.push_back({carlo::Mirror{Rgb(ball_reflectance)}, false});
  scene.shapes.push_back({carlo::Sphere{{0, 0, 0}, ball_radius}, 1, Rgb(0)});
  return scene;
}

inline std::vector<DensityPhoton> photons_everywhere(Rng& rng) {
  std::vector<DensityPhoton> photons;
  for (int i = 0; i < photon_pairs; ++i) {
    DensityPhoton photon{drawn_direction(rng), drawn_direction(rng), {0, pair_flux, 0}, 0, 1};
    photons.push_back(photon);
    photon.wi = -photon.wi;
    photons.push_back(photon);
  }
  return photons;
}

}  // namespace lab09_density
