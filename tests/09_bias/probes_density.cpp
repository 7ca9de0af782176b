// Probes of exercise 9.5: they call the student's functions and return raw values;
// checks_density.cpp and checks_density_paths.cpp say what the values should be. No photon comes
// from the student's Lab 9.4.

#include "09_bias/density_scenes.h"
#include "bias.h"
#include "grader/worker/probe.h"

#include <utility>

namespace lab09_density {

using carlo::grader::RowWriter;
using lab09::PhotonMap;
using lab09::Surface;

namespace {

void add_radiance(RowWriter& rows, Rgb radiance) {
  rows.add({static_cast<double>(radiance.r), static_cast<double>(radiance.g),
            static_cast<double>(radiance.b)});
}

PhotonMap map_of(const std::vector<DensityPhoton>& photons) {
  std::vector<lab09::Photon> stored;
  for (const auto& [p, wi, flux, phong, specular] : photons)
    stored.push_back({p, wi, flux, phong, specular});
  return {std::move(stored), 1};
}

const lab08::Material& grey() {
  static const lab08::Material material = carlo::Phong{Rgb(0.5f), Rgb(0), 0};
  return material;
}

Surface surface_at(Vec3 p) {
  return {p, density_normal, density_wo, density_glow, &grey(), true, {}};
}

PhotonMap uniform_map(Rng& rng) {
  std::vector<DensityPhoton> photons;
  for (int i = 0; i < uniform_photons; ++i) {
    const float r = std::sqrt(rng.uniform_float());
    const float phi = 2 * carlo::pi_f * rng.uniform_float();
    photons.push_back({{r * std::cos(phi), r * std::sin(phi), 0},
                       {0.6f, 0, 0.8f},
                       Rgb(carlo::pi_f / uniform_photons),
                       0,
                       0});
  }
  return map_of(photons);
}

/// The result of radiance_within() itself at a point, with density_brdf().
Rgb radiance_at(const PhotonMap& map, Vec3 p, Vec3 n, float radius) {
  Surface surface = surface_at(p);
  surface.n = n;
  return lab09::radiance_within(map, surface, density_brdf, radius);
}

/// photon_radiance() or caustic_radiance().
Rgb radiance_along(bool caustic, const lab08::World& world, const carlo::Ray& ray,
                   const PhotonMap& map, float radius, Rng& rng) {
  return caustic ? lab09::caustic_radiance(world, ray, map, radius, rng)
                 : lab09::photon_radiance(world, ray, map, radius, rng);
}

}  // namespace

PROBE("Lab 9.5 within", "red", "green", "blue",
      "(a row for each place; then with an empty map, and with all photons beyond the radius)") {
  Rng rng(params.seed);
  RowWriter rows;
  for (const DensityPlace& place : density_places) {
    const PhotonMap map =
        map_of(drawn_photons(rng, density_photons, place.at, density_normal, place.radius));
    add_radiance(rows,
                 lab09::radiance_within(map, surface_at(place.at), density_brdf, place.radius));
  }
  add_radiance(rows, lab09::radiance_within({}, surface_at({1, 2, 3}), density_brdf, 0.5f));
  const PhotonMap map = map_of(drawn_photons(rng, density_photons, {0, 0, 0}, density_normal, 1));
  add_radiance(rows, lab09::radiance_within(map, surface_at({9, 9, 9}), density_brdf, 1));
  return rows.take();
}

PROBE("Lab 9.5 nearest", "red", "green", "blue",
      "(a row for each k at each place; then with fewer photons than k, and with none)") {
  Rng rng(params.seed);
  RowWriter rows;
  PhotonMap map;
  for (const DensityPlace& place : density_places) {
    map = map_of(drawn_photons(rng, density_photons, place.at, density_normal, place.radius));
    for (const int k : density_counts)
      add_radiance(rows, lab09::radiance_nearest(map, surface_at(place.at), density_brdf, k));
  }
  const Surface surface = surface_at(density_places.back().at);
  add_radiance(rows, lab09::radiance_nearest(map, surface, density_brdf, density_photons + 1));
  add_radiance(rows, lab09::radiance_nearest({}, surface, density_brdf, 2));
  return rows.take();
}

PROBE("Lab 9.5 uniform", "nearest", "within") {
  Rng rng(params.seed);
  Surface surface = surface_at({0, 0, 0});
  surface.n = {0, 0, 1};
  const auto one = [](Vec3) { return Rgb(1); };
  RowWriter rows;
  for (std::int64_t i = 0; i < params.n; ++i) {
    const PhotonMap map = uniform_map(rng);
    rows.add({static_cast<double>(lab09::radiance_nearest(map, surface, one, uniform_nearest).r),
              static_cast<double>(lab09::radiance_within(map, surface, one, uniform_radius).r)});
  }
  return rows.take();
}

PROBE("Lab 9.5 sights", "red", "green", "blue",
      "(last row: radiance_within() where the ray ends)") {
  const auto sight = static_cast<Sight>(params.whole("sight"));
  const lab08::World world(sight_scene(sight));
  Rng rng(params.seed);
  const PhotonMap map =
      map_of(drawn_photons(rng, target_photons, {0, 0, 0}, {0, 0, 1}, target_radius));
  RowWriter rows;
  for (std::int64_t i = 0; i < params.n; ++i)
    add_radiance(rows, radiance_along(params.whole("caustic") == 1, world, sight_ray(sight), map,
                                      target_radius, rng));
  add_radiance(rows, radiance_at(map, {0, 0, 0}, {0, 0, 1}, target_radius));
  return rows.take();
}

PROBE("Lab 9.5 white ball", "red", "green", "blue") {
  const lab08::World world(white_ball_scene(params.whole("glass") == 1));
  Rng rng(params.seed);
  RowWriter rows;
  for (std::int64_t i = 0; i < params.n; ++i) {
    const float aim = 0.3f * rng.uniform_float();
    add_radiance(rows, radiance_along(params.whole("caustic") == 1, world,
                                      {{aim, 0.1f, 5}, {0, 0, -1}}, {}, 0.1f, rng));
  }
  return rows.take();
}

PROBE("Lab 9.5 sphere", "red: of the wall's light", "green: of photons",
      "(last row: radiance_within() at a point of the wall)") {
  const lab08::World world(ball_in_sphere());
  Rng rng(params.seed);
  const PhotonMap map = map_of(photons_everywhere(rng));
  const float z = params.whole("mirrored") == 1 ? -0.6f : 0.6f;
  RowWriter rows;
  for (std::int64_t i = 0; i < params.n; ++i) {
    const carlo::Ray ray{{0.1f, 0.2f, 0.7f}, glm::normalize(Vec3(0.1f, -0.2f, z))};
    const Rgb radiance =
        radiance_along(params.whole("caustic") == 1, world, ray, map, everywhere, rng);
    rows.add({static_cast<double>(radiance.r), static_cast<double>(radiance.g)});
  }
  const Rgb within = radiance_at(map, {0, 0, -1}, {0, 0, 1}, everywhere);
  rows.add({static_cast<double>(within.r), static_cast<double>(within.g)});
  return rows.take();
}

}  // namespace lab09_density
