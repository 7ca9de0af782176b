// Checks of exercise 9.4: photons as they leave lights. All four numbers of an emission are uniform
// once they are mapped back to [0, 1): the position on the light, the square of the cosine, and the
// azimuth.

#include "09_bias/photon_checks.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

namespace lab09_photons {

using namespace carlo::grader;

namespace {

const Diagnosis flux_is_intensity{"flux-is-intensity",
                                  "intensity is power per solid angle, and the photon represents "
                                  "all directions: multiply by the sphere's solid angle."};
const Diagnosis half_sphere_flux{
    "flux-of-a-half-sphere",
    "2 pi is the solid angle of a hemisphere; a point light emits in all directions."};
const Diagnosis half_sphere{"half-of-the-sphere",
                            "a point light emits in all directions: no photon goes to one of the "
                            "sides."};
const Diagnosis polar_angle{"polar-angle-uniform",
                            "uniform directions have a uniform cosine, not a uniform angle: too "
                            "many go to the poles."};
const Diagnosis cube_corners{
    "cube-not-rejected",
    "points of a cube, normalised, crowd towards its corners: reject those "
    "outside of the ball, or invert."};
const Diagnosis numbers_twice{"random-number-reused",
                              "one random number serves two purposes: point and direction need "
                              "four of their own."};
const Diagnosis pi_missing{"pi-missing",
                           "radiance integrated over the hemisphere with its cosine is pi Le."};
const Diagnosis solid_angle_of_hemisphere{"cosine-missing-in-power",
                                          "the power includes the cosine, whose integral over "
                                          "the hemisphere is pi, not 2 pi."};
const Diagnosis area_missing{"area-missing", "a light's power is proportional to its area."};
const Diagnosis not_cosine{
    "directions-not-cosine-weighted",
    "directions are not cosine-weighted: a light of constant radiance emits photons in "
    "proportion to the cosine."};
const Diagnosis not_turned{"direction-not-turned",
                           "directions are local: transform them by a frame of the light's "
                           "normal at the point."};
const Diagnosis meets_light{"photon-meets-its-light",
                            "photons start behind the light's surface because of rounding, and "
                            "hit it at once: leave() offsets their origins."};
const Diagnosis fixed_offset{"fixed-offset",
                             "photons start at a fixed distance from the light, which is large "
                             "compared to a small one: leave() uses an offset that rounding "
                             "requires."};

/// The azimuth of d about n, from a fixed perpendicular direction.
double azimuth_about(PhotonVec n, PhotonVec d) {
  const PhotonVec s =
      glm::normalize(glm::cross(n, std::abs(n.z) < 0.9 ? PhotonVec(0, 0, 1) : PhotonVec(1, 0, 0)));
  return turn_of(glm::dot(d, glm::cross(n, s)), glm::dot(d, s));
}

}  // namespace

TEST_CASE("Lab 9.4: a point light shines all around", "[lab09][ex4]") {
  constexpr std::size_t photons = 20'000;
  const Rows rows = probe("Lab 9.4 point", {.n = photons}, {.rows = photons, .columns = 9});
  const PhotonVec intensity(light_radiance), flux = 4 * std::numbers::pi * intensity;
  judge_flux("the flux of a photon of a point light", fluxes(rows, 6), flux,
             {{intensity, flux_is_intensity}, {flux / 2.0, half_sphere_flux}});
  double elsewhere = 0, not_unit = 0;
  PhotonCells<2> cells(9);
  double z2 = 0, z4 = 0;
  for (std::size_t i = 0; i < photons; ++i) {
    const PhotonVec d = vec(rows, i, 3);
    elsewhere += vec(rows, i, 0) == PhotonVec(1, 2, 3) ? 0 : 1;
    not_unit += std::abs(glm::length(d) - 1) <= 1e-5 ? 0 : 1;
    cells.add({(d.z + 1) / 2, turn_of(d.y, d.x)});
    z2 += d.z * d.z / photons;
    z4 += d.z * d.z * d.z * d.z / photons;
  }
  judge(holds("photons that start elsewhere", elsewhere == 0, fmt::format("{:g}", elsewhere), "0"));
  judge(holds("directions of another length than 1", not_unit == 0, fmt::format("{:g}", not_unit),
              "0"));
  Verdict verdict = cells.verdict("directions, in cells of equal solid angle");
  const double up = cells.mean(0), around = cells.mean(1);
  if (!verdict.passed) {
    const bool one_side = std::abs(up - 0.5) > 0.2 || std::abs(around - 0.5) > 0.2;
    if (one_side)
      verdict.diagnoses = {half_sphere};
    else if (cells.correlated())
      verdict.diagnoses = {numbers_twice};
    else if (z2 > 0.4)
      verdict.diagnoses = {polar_angle};
    else if (z4 < 0.19)
      verdict.diagnoses = {cube_corners};
  }
  judge(verdict);
}

namespace {

/// A photon that left a light: its origin in numbers of [0, 1), the normal there, and how far in
/// front of the light it starts.
struct Departure {
  double u, v;
  PhotonVec n;
  double in_front;
};

Departure departure(PhotonLight light, PhotonVec o) {
  if (light == PhotonLight::rectangle) {
    const PhotonVec u(light_rectangle.u), v(light_rectangle.v),
        from = o - PhotonVec(light_rectangle.origin);
    const PhotonVec n = glm::normalize(glm::cross(u, v));
    return {glm::dot(from, u) / glm::dot(u, u), glm::dot(from, v) / glm::dot(v, v), n,
            glm::dot(from, n)};
  }
  if (light == PhotonLight::ball) {
    const PhotonVec from = o - PhotonVec(light_ball.center), n = glm::normalize(from);
    return {(n.z + 1) / 2, turn_of(n.y, n.x), n,
            glm::length(from) - static_cast<double>(light_ball.radius)};
  }
  const PhotonVec from = o - PhotonVec(light_speck.center);
  const double r = glm::length(glm::dvec2(from)) / static_cast<double>(light_speck.radius);
  return {r * r, turn_of(from.y, from.x), {0, 0, 1}, from.z};
}

double light_area(PhotonLight light) {
  if (light == PhotonLight::rectangle) return 1.5;
  const auto r =
      static_cast<double>(light == PhotonLight::ball ? light_ball.radius : light_speck.radius);
  return (light == PhotonLight::ball ? 4 : 1) * std::numbers::pi * r * r;
}

/// Statistics of the photons of one light.
struct Departures {
  PhotonCells<4> cells{3};
  double behind = 0, far = 0, backwards = 0, not_unit = 0, up = 0, cosines = 0;

  Departures(PhotonLight light, const Rows& rows) {
    // A dozen roundings of the largest coordinate, with a margin.
    const double farthest = light == PhotonLight::speck ? 1e-6 : 1e-3;
    for (std::size_t i = 0; i < rows.count(); ++i) {
      const PhotonVec d = vec(rows, i, 3);
      const Departure from = departure(light, vec(rows, i, 0));
      const double cosine = glm::dot(from.n, d);
      behind += from.in_front >= 0 ? 0 : 1;
      far += from.in_front <= farthest ? 0 : 1;
      backwards += cosine > -1e-5 ? 0 : 1;
      not_unit += std::abs(glm::length(d) - 1) <= 1e-5 ? 0 : 1;
      up += d.z >= -1e-6 ? 1 : 0;
      cosines += cosine / static_cast<double>(rows.count());
      cells.add({from.u, from.v, cosine * cosine, azimuth_about(from.n, d)});
    }
  }
};

void judge_departures(PhotonLight light, const std::string& name, const Rows& rows) {
  const PhotonVec radiance(light_radiance);
  const double pi = std::numbers::pi, area = light_area(light);
  const bool one_flux =
      judge_flux("the flux of a photon of " + name, fluxes(rows, 6), pi * area * radiance,
                 {{area * radiance, pi_missing},
                  {2 * pi * area * radiance, solid_angle_of_hemisphere},
                  {pi * radiance, area_missing}});
  const Departures seen(light, rows);
  const auto none = [&](const char* what, double count, const std::vector<Diagnosis>& diagnoses) {
    judge(holds(fmt::format("photons of {} that {}", name, what), count == 0,
                fmt::format("{:g} of {}", count, rows.count()), "0", diagnoses));
  };
  const bool unturned = seen.up == static_cast<double>(rows.count()) && light != PhotonLight::speck;
  none("go back into it", seen.backwards,
       unturned ? std::vector{not_turned} : std::vector<Diagnosis>{});
  none("have a direction of another length than 1", seen.not_unit, {});
  none("start behind its surface", seen.behind,
       unturned ? std::vector<Diagnosis>{} : std::vector{meets_light});
  none("start farther off it than rounding asks for", seen.far, {fixed_offset});
  if (light == PhotonLight::speck) return;
  Verdict verdict = seen.cells.verdict("points and directions of " + name);
  if (!verdict.passed && seen.backwards == 0 && one_flux) {
    if (seen.cells.correlated())
      verdict.diagnoses = {numbers_twice};
    else if (std::abs(seen.cosines - 0.5) < 0.02)
      verdict.diagnoses = {not_cosine};
  }
  judge(verdict);
}

}  // namespace

TEST_CASE("Lab 9.4: a light sends photons in proportion to the cosine", "[lab09][ex4]") {
  constexpr std::size_t photons = 20'000;
  const char* const names[] = {"a rectangle", "a ball", "a speck of light"};
  for (const PhotonLight light : {PhotonLight::rectangle, PhotonLight::ball, PhotonLight::speck}) {
    const std::string name = names[static_cast<int>(light)];
    const std::size_t count = light == PhotonLight::speck ? 500 : photons;
    judge_departures(light, name,
                     probe("Lab 9.4 light",
                           {.n = static_cast<std::int64_t>(count),
                            .numbers = {{"light", static_cast<double>(light)}}},
                           {.rows = count, .columns = 9, .of = name}));
  }
}

}  // namespace lab09_photons
