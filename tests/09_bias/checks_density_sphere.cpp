// Checks of exercise 9.5: no light by two roads, and none by neither. In a closed sphere that emits
// and reflects, with a ball of mirror in its middle, every part of the light is a geometric series.
// The photons bring a colour that no lamp has.

#include "09_bias/density_checks.h"

#include <cmath>
#include <numbers>

namespace lab09_density {

using namespace carlo::grader;

namespace {

const Diagnosis caustics_twice{"caustics-counted-twice",
                               "emission that a path sees in a mirror, after a Phong surface, is "
                               "counted; that is a caustic, and the map has it."};
const Diagnosis direct_twice{"direct-light-counted-twice",
                             "emission that a path meets after a Phong surface is counted; "
                             "direct_by_area() has counted it."};
const Diagnosis direct_missing{"direct-light-missing",
                               "the light that comes straight from lamps is missing at Phong "
                               "surfaces: a map of caustics does not have it."};
const Diagnosis path_ends{"path-ends-at-phong",
                          "the path ends at the first Phong surface: light that came by other "
                          "Phong surfaces is in no map of caustics."};
const Diagnosis first_caustic_only{"caustics-at-first-surface-only",
                                   "photons count at the path's first Phong surface only: later "
                                   "ones have caustics, too."};
const Diagnosis first_caustic_missing{"caustics-not-at-first-surface",
                                      "photons do not count at the path's first Phong surface."};
const Diagnosis no_caustics{"photons-missing",
                            "photons bring nothing at the surface that the ray meets."};
const Diagnosis camera_emission_missing{
    "emission-missing", "what the first Phong surface emits is missing: the camera sees it."};
const Diagnosis mirrored_emission_missing{
    "mirrored-emission-missing",
    "emission that the camera sees in a mirror is missing: no photon stands for it, for no Phong "
    "surface lies between."};
const Diagnosis weight_twice{"albedo-in-place-of-weight",
                             "sample() absorbs paths already: its weight is what is left to "
                             "multiply, not the albedo."};
const Diagnosis goes_on{"path-goes-on",
                        "the path goes on after the first Phong surface: a map of all photons has "
                        "that light already."};
const Diagnosis samples_beside_map{"light-sampled-beside-the-map",
                                   "light is sampled beside the map: a map of all photons has that "
                                   "light already."};
const Diagnosis sky_by_camera_only{"environment-lost-after-phong",
                                   "rays that leave a Phong surface and meet nothing bring the "
                                   "environment: nobody else does."};

// The sphere --------------------------------------------------------------------------------------

/// From a point of the wall, in cosine-weighted directions, this share sees the ball.
constexpr double share_of_ball =
    static_cast<double>(ball_radius) * static_cast<double>(ball_radius);
constexpr auto albedo = static_cast<double>(wall_albedo);
constexpr auto mirror = static_cast<double>(ball_reflectance);

/// What one vertex on the wall brings by itself.
struct Vertex {
  double mean, square;
};

/// Direct light of each vertex: the one point that is sampled is seen or it is hidden by the ball,
/// and all that are seen bring the same.
constexpr double lit = albedo * static_cast<double>(wall_glow);
constexpr Vertex by_lamp{lit * (1 - share_of_ball), lit* lit*(1 - share_of_ball)};

Vertex by_photons() {
  const auto r = static_cast<double>(everywhere), flux = static_cast<double>(pair_flux);
  const double radiance =
      albedo / std::numbers::pi * photon_pairs * flux / (std::numbers::pi * r * r);
  return {radiance, radiance * radiance};
}

/// The mean of what goes on from a vertex: straight to the wall, or by the mirror.
constexpr double onwards = albedo * (1 - share_of_ball + share_of_ball * mirror);

/// A path's light from vertex 1 on, of which each brings the same on average.
Theory path_theory(const Vertex& vertex) {
  const double mean = vertex.mean / (1 - onwards);
  const double squares = albedo * (1 - share_of_ball + share_of_ball * mirror * mirror);
  const double square = (vertex.square + 2 * vertex.mean * onwards * mean) / (1 - squares);
  return {mean, std::sqrt(square - mean * mean)};
}

double mean_of_path(double vertex) {
  return vertex / (1 - onwards);
}

Rows sphere_rows(bool caustic, bool mirrored, std::size_t rays) {
  return probe("Lab 9.5 sphere",
               {.n = static_cast<std::int64_t>(rays),
                .numbers = {{"caustic", caustic ? 1 : 0}, {"mirrored", mirrored ? 1 : 0}}},
               {.rows = rays,
                .columns = 2,
                .finite = true,
                .of = mirrored ? "a glowing sphere in its mirror" : "a glowing sphere"});
}

Suspects lamp_suspects(double glow) {
  const double straight = lit * (1 - share_of_ball), by_mirror = lit * share_of_ball * mirror;
  const double all = glow + mean_of_path(by_lamp.mean);
  return {{all + mean_of_path(by_mirror), caustics_twice},
          {all + mean_of_path(straight), direct_twice},
          {all + mean_of_path(straight + by_mirror), direct_twice},
          {glow + mean_of_path(straight + by_mirror) - straight, direct_twice},
          {glow, direct_missing},
          {glow + straight, path_ends},
          {glow + straight / (1 - albedo * onwards), weight_twice},
          {all - glow, camera_emission_missing}};
}

Suspects photon_suspects() {
  const double each = by_photons().mean, all = mean_of_path(each);
  return {{each, first_caustic_only},
          {all - each, first_caustic_missing},
          {each / (1 - albedo * onwards), weight_twice},
          {0, no_caustics}};
}

Suspects times(double factor, Suspects suspects) {
  for (Suspect& suspect : suspects)
    suspect.value *= factor;
  return suspects;
}

}  // namespace

TEST_CASE("Lab 9.5: no light by two roads, and none by neither", "[lab09][ex5]") {
  constexpr std::size_t rays = 10'000;
  constexpr auto glow = static_cast<double>(wall_glow);
  const Theory lamp = path_theory(by_lamp), photons = path_theory(by_photons());
  const Rows straight = sphere_rows(true, false, rays);
  judge(mean_is("the wall's radiance by its own light", column(straight, 0),
                {glow + lamp.mean, lamp.sd}, lamp_suspects(glow)));
  judge(mean_is("the wall's radiance by photons", column(straight, 1), photons, photon_suspects()));
  const Rows mirrored = sphere_rows(true, true, rays);
  Suspects suspects = times(mirror, lamp_suspects(glow));
  suspects.push_back({mirror * lamp.mean, mirrored_emission_missing});
  judge(mean_is("the wall's radiance by its own light, in the mirror", column(mirrored, 0),
                {mirror * (glow + lamp.mean), mirror * lamp.sd}, suspects));
  judge(mean_is("the wall's radiance by photons, in the mirror", column(mirrored, 1),
                {mirror * photons.mean, mirror * photons.sd}, times(mirror, photon_suspects())));
}

TEST_CASE("Lab 9.5: a map of all photons is all of the reflected light", "[lab09][ex5]") {
  constexpr std::size_t rays = 40;
  constexpr auto glow = static_cast<double>(wall_glow);
  for (const bool mirrored : {false, true}) {
    const Rows rows = sphere_rows(false, mirrored, rays);
    const double weight = mirrored ? mirror : 1;
    double wrong_lamp = 0, wrong_photons = 0;
    for (std::size_t i = 0; i < rays; ++i) {
      wrong_lamp += std::abs(rows.at(i, 0) - weight * glow) <= 1e-4 ? 0 : 1;
      wrong_photons += std::abs(rows.at(i, 1) - weight * by_photons().mean) <= 1e-4 ? 0 : 1;
    }
    const std::string where = mirrored ? " in a mirror" : "";
    std::vector<Diagnosis> found;
    // What is sampled at one surface alone leaves the photons' part as it is.
    if (wrong_lamp > 0) found = {wrong_photons > 0 ? goes_on : samples_beside_map};
    judge(holds("rays to a wall" + where + " that bring more than it emits, of its own light",
                wrong_lamp == 0, fmt::format("{:g} of {}", wrong_lamp, rays), "0", found));
    judge(holds("rays to a wall" + where + " that bring another radiance by photons",
                wrong_photons == 0, fmt::format("{:g} of {}", wrong_photons, rays), "0", found));
  }
}

// Under a sky -------------------------------------------------------------------------------------

namespace {

void judge_white_ball(bool caustic, bool in_glass) {
  constexpr std::size_t rays = 100;
  const std::string name = in_glass ? "a white ball in glass" : "a white ball";
  const Rows rows =
      probe("Lab 9.5 white ball",
            {.n = rays, .numbers = {{"caustic", caustic ? 1 : 0}, {"glass", in_glass ? 1 : 0}}},
            {.rows = rays, .columns = 3, .finite = false, .of = name + " under a sky"});
  const DensityVec expected = caustic ? DensityVec(sky) : DensityVec(0);
  double wrong = 0, dark = 0;
  DensityVec shown = expected;
  for (const DensityVec& value : radiances(rows)) {
    dark += value == DensityVec(0) ? 1 : 0;
    // What the glass reflects towards the sky is seen by both.
    const bool right =
        same_radiance(value, expected) || (in_glass && same_radiance(value, DensityVec(sky)));
    if (!right) shown = value;
    wrong += right ? 0 : 1;
  }
  std::vector<Diagnosis> found;
  if (caustic && dark > 0) found = {sky_by_camera_only};
  if (!caustic && same_radiance(shown, DensityVec(sky))) found = {goes_on};
  judge(holds(fmt::format("the radiance of {} under a sky, {}", name,
                          caustic ? "by a map of caustics that has none"
                                  : "by an empty map of all photons"),
              wrong == 0, fmt::format("{} for {:g} of {}", radiance_text(shown), wrong, rays),
              radiance_text(expected), found));
}

}  // namespace

TEST_CASE("Lab 9.5: the sky reaches paths wherever they end", "[lab09][ex5]") {
  for (const bool caustic : {true, false})
    judge_white_ball(caustic, false);
  judge_white_ball(true, true);
}

}  // namespace lab09_density
