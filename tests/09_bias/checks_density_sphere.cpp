// Checks of exercise 9.5: all light comes by exactly one way. In a closed sphere that emits and
// reflects, with a ball of mirror in its middle, every part of the light is a geometric series. The
// photons have a colour that no light has.

#include "09_bias/density_checks.h"

#include <algorithm>
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
const Diagnosis direct_missing{
    "direct-light-missing",
    "the light that comes straight from light sources is missing at Phong "
    "surfaces: a map of caustics does not have it."};
const Diagnosis first_direct_only{
    "direct-light-at-first-surface-only",
    "lights are sampled only at the path's first Phong surface: later ones are lit, too."};
const Diagnosis path_ends{"path-ends-at-phong",
                          "the path ends at the first Phong surface: light via other Phong "
                          "surfaces is not in a map of caustics."};
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
const Diagnosis continues{
    "path-goes-on",
    "the path goes on after the first Phong surface: a map of all photons has "
    "that light already."};
const Diagnosis samples_beside_map{"light-sampled-beside-the-map",
                                   "light is sampled beside the map: a map of all photons has that "
                                   "light already."};
const Diagnosis sky_by_camera_only{"environment-lost-after-phong",
                                   "rays that leave a Phong surface and meet nothing have to add "
                                   "the environment: nothing else does."};

// The sphere --------------------------------------------------------------------------------------

/// The fraction of cosine-weighted directions from a point of the wall that meets the ball.
constexpr double share_of_ball =
    static_cast<double>(ball_radius) * static_cast<double>(ball_radius);
constexpr auto albedo = static_cast<double>(wall_albedo);
constexpr auto mirror = static_cast<double>(ball_reflectance);

/// The contribution of one vertex on the wall.
struct Vertex {
  double mean, square;
};

/// Direct light at each vertex: the sampled point is visible or hidden by the ball, and all visible
/// points contribute the same.
constexpr double lit = albedo * static_cast<double>(wall_glow);
constexpr Vertex by_light{lit * (1 - share_of_ball), lit* lit*(1 - share_of_ball)};

Vertex by_photons() {
  const auto r = static_cast<double>(everywhere), flux = static_cast<double>(pair_flux);
  const double radiance =
      albedo / std::numbers::pi * photon_pairs * flux / (std::numbers::pi * r * r);
  return {radiance, radiance * radiance};
}

/// The mean of what continues from a vertex: straight to the wall, or by the mirror.
constexpr double onwards = albedo * (1 - share_of_ball + share_of_ball * mirror);

/// A path's light from vertex 1 on; each vertex contributes the same on average.
Theory path_theory(const Vertex& vertex) {
  const double mean = vertex.mean / (1 - onwards);
  const double squares = albedo * (1 - share_of_ball + share_of_ball * mirror * mirror);
  const double square = (vertex.square + 2 * vertex.mean * onwards * mean) / (1 - squares);
  return {mean, std::sqrt(square - mean * mean)};
}

double mean_of_path(double vertex) {
  return vertex / (1 - onwards);
}

/// The radiance of rays, and whether radiance_within() is right, so that mistakes are the path's.
struct SphereRays {
  std::vector<double> light, photons;
  bool density_right = true;
};

SphereRays sphere_rays(bool caustic, bool mirrored, std::size_t rays) {
  const Answer rows =
      probe("Lab 9.5 sphere",
            {.n = static_cast<std::int64_t>(rays),
             .numbers = {{"caustic", caustic ? 1 : 0}, {"mirrored", mirrored ? 1 : 0}}},
            {.rows = rays + 1,
             .columns = 2,
             .finite = true,
             .of = mirrored ? "a glowing sphere in its mirror" : "a glowing sphere"});
  SphereRays all{column(rows, 0), column(rows, 1)};
  Rng rng(rows.seed);
  const DensityVec within = density_within(photons_everywhere(rng), {0, 0, -1}, {0, 0, 1},
                                           static_cast<double>(everywhere));
  all.density_right = same_radiance({all.light.back(), all.photons.back(), 0}, within);
  all.light.pop_back();
  all.photons.pop_back();
  return all;
}

/// mean_is(), but with suspects reported even if all values are alike.
Verdict judge_part(const std::string& what, const std::vector<double>& values, const Theory& theory,
                   const Suspects& suspects) {
  Verdict verdict = mean_is(what, values, theory, suspects);
  double mean = 0;
  for (const double value : values)
    mean += value / static_cast<double>(values.size());
  for (const Suspect& suspect : suspects) {
    if (!verdict.passed && verdict.diagnoses.empty() && std::abs(mean - suspect.value) <= 1e-5)
      verdict.diagnoses = {suspect.diagnosis};
  }
  judge(verdict);
  return verdict;
}

bool has_diagnosis(const Verdict& verdict, const Diagnosis& diagnosis) {
  return std::any_of(verdict.diagnoses.begin(), verdict.diagnoses.end(),
                     [&](const Diagnosis& one) { return one.id == diagnosis.id; });
}

/// True if paths end at the first Phong surface: then the photons' contribution there is always
/// everything.
bool end_at_first(const std::vector<double>& by_photons_of_rays, double weight) {
  return std::all_of(by_photons_of_rays.begin(), by_photons_of_rays.end(), [&](double value) {
    return std::abs(value - weight * by_photons().mean) <= 1e-4;
  });
}

/// `ends`: end_at_first().
Suspects light_suspects(double glow, bool ends) {
  const double straight = lit * (1 - share_of_ball), by_mirror = lit * share_of_ball * mirror;
  const double all = glow + mean_of_path(by_light.mean);
  return {{all + mean_of_path(by_mirror), caustics_twice},
          {all + mean_of_path(straight), direct_twice},
          {all + mean_of_path(straight + by_mirror), direct_twice},
          {glow + mean_of_path(straight + by_mirror) - straight, direct_twice},
          {glow, direct_missing},
          {glow + straight, ends ? path_ends : first_direct_only},
          {glow + straight / (1 - albedo * onwards), weight_twice}};
}

/// `ends`: the path's own light has shown that it ends at the first surface.
Suspects photon_suspects(bool ends) {
  const double each = by_photons().mean, all = mean_of_path(each);
  return {{each, ends ? path_ends : first_caustic_only},
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
  const Theory light = path_theory(by_light), photons = path_theory(by_photons());
  for (const bool mirrored : {false, true}) {
    const SphereRays seen = sphere_rays(true, mirrored, rays);
    const double weight = mirrored ? mirror : 1;
    Suspects of_light;
    if (seen.density_right) {
      of_light = times(weight, light_suspects(glow, end_at_first(seen.photons, weight)));
      of_light.push_back(
          {weight * light.mean, mirrored ? mirrored_emission_missing : camera_emission_missing});
    }
    const std::string where = mirrored ? ", in the mirror" : "";
    const Verdict by_light =
        judge_part("the wall's radiance by its own light" + where, seen.light,
                   {weight * (glow + light.mean), weight * light.sd}, of_light);
    const Suspects of_photons =
        seen.density_right ? times(weight, photon_suspects(has_diagnosis(by_light, path_ends)))
                           : Suspects{};
    judge_part("the wall's radiance by photons" + where, seen.photons,
               {weight * photons.mean, weight * photons.sd}, of_photons);
  }
}

TEST_CASE("Lab 9.5: a map of all photons is all of the reflected light", "[lab09][ex5]") {
  constexpr std::size_t rays = 40;
  for (const bool mirrored : {false, true}) {
    const SphereRays seen = sphere_rays(false, mirrored, rays);
    const double weight = mirrored ? mirror : 1;
    const auto wrong = [&](const std::vector<double>& values, double expected) {
      return static_cast<double>(std::count_if(values.begin(), values.end(), [&](double value) {
        return !(std::abs(value - weight * expected) <= 1e-4);
      }));
    };
    const auto differ = [](const std::vector<double>& values) {
      const auto [least, most] = std::minmax_element(values.begin(), values.end());
      return *most - *least > 1e-3;
    };
    const double wrong_light = wrong(seen.light, static_cast<double>(wall_glow));
    const double wrong_photons = wrong(seen.photons, by_photons().mean);
    std::vector<Diagnosis> found;
    // If light is sampled at only one surface, the photons' part is unaffected.
    if (seen.density_right && differ(seen.light))
      found = {differ(seen.photons) ? continues : samples_beside_map};
    const std::string where = mirrored ? "in a mirror" : "seen straight";
    judge(holds("rays to a wall " + where + " that bring another light of its own than it emits",
                wrong_light == 0, fmt::format("{:g} of {}", wrong_light, rays), "0", found));
    // A photon that arrives along the wall, as in four of a million gradings, has no side.
    judge(holds("rays to a wall " + where + " that bring another light by photons",
                wrong_photons <= 1, fmt::format("{:g} of {}", wrong_photons, rays), "none, or one",
                found));
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
    // Both see the light that the glass reflects towards the sky.
    const bool right =
        same_radiance(value, expected) || (in_glass && same_radiance(value, DensityVec(sky)));
    if (!right) shown = value;
    wrong += right ? 0 : 1;
  }
  std::vector<Diagnosis> found;
  if (caustic && dark > 0) {
    const SphereRays in_sphere = sphere_rays(true, false, 200);
    found = {end_at_first(in_sphere.photons, 1) ? path_ends : sky_by_camera_only};
  }
  if (!caustic && same_radiance(shown, DensityVec(sky))) found = {continues};
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
