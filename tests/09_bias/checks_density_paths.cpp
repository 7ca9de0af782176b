// Checks of exercise 9.5: rays that meet photons. The radiance of each ray, or its mean, is known
// in closed form for these worlds; the photons follow from the probe's seed.

#include "09_bias/density_checks.h"

#include <numbers>

namespace lab09_density {

using namespace carlo::grader;

namespace {

const Diagnosis sight_emission_missing{
    "emission-missing", "what the first Phong surface emits is missing: the camera sees it."};
const Diagnosis sight_photons_missing{"photons-missing",
                                      "photons bring nothing at the surface that the ray meets."};
const Diagnosis mirror_weight_missing{"weight-missing",
                                      "mirrors and glass have a weight, which is missing."};
const Diagnosis emission_unweighted{"weight-missing-for-emission",
                                    "emission is added without the weights of the mirrors and of "
                                    "the glass before it."};
const Diagnosis mirrored_emission_lost{
    "mirrored-emission-missing",
    "emission that the camera sees in a mirror is missing: no photon stands for it, for no Phong "
    "surface lies between."};
const Diagnosis photons_unweighted{"weight-missing-for-photons",
                                   "the photons' contribution is added without the weights of "
                                   "the mirrors and of the glass before it."};
const Diagnosis last_weight_only{"last-weight-only",
                                 "only the last mirror's weight counts: weights multiply."};
const Diagnosis glass_as_flux{
    "radiance-not-scaled",
    "radiance has to be scaled by eta^2 where the ray enters glass. (Flux was not.)"};
const Diagnosis sky_missing{"environment-missing",
                            "the radiance of a ray that meets nothing is the environment's."};
const Diagnosis sky_unweighted{"weight-missing-for-environment",
                               "the environment is added without the mirror's weight."};
const Diagnosis samples_beside{"light-sampled-beside-the-map",
                               "light is sampled beside the map: a map of all photons has that "
                               "light already."};
DensityVec phong_of(Vec3 wi_, Vec3 wo_) {
  const DensityVec wi(wi_), wo(wo_), n(0, 0, 1);
  if (!(wi.z > 0)) return DensityVec(0);
  const double cosine = std::max(0.0, glm::dot(wi, 2 * wo.z * n - wo));
  const double exponent = static_cast<double>(target_phong.exponent), pi = std::numbers::pi;
  return DensityVec(target_phong.kd) / pi +
         DensityVec(target_phong.ks) * ((exponent + 2) / (2 * pi)) * std::pow(cosine, exponent);
}

std::vector<DensityPhoton> photons_on_target(std::uint64_t seed) {
  Rng rng(seed);
  return drawn_photons(rng, target_photons, {0, 0, 0}, {0, 0, 1}, target_radius);
}

/// The radiance due to the photons on the target.
DensityVec photon_radiance_of_target(const std::vector<DensityPhoton>& photons, Vec3 wo) {
  const auto r = static_cast<double>(target_radius);
  DensityVec sum(0);
  for (const DensityPhoton& photon : photons) {
    if (glm::length(DensityVec(photon.p)) < r)
      sum += phong_of(photon.wi, wo) * DensityVec(photon.flux);
  }
  return sum / (std::numbers::pi * r * r);
}

constexpr std::size_t sight_rays = 100;

/// The right radiance of a ray to the target, and those due to mistakes.
struct Seen {
  DensityVec is{0};  ///< the radiance of all rays; of those that glass did not reflect
  DensityVec weight{1}, last_weight{1};
  DensityVec emitted{0}, photons{0}, around{0};
};

/// Properties that take more than a single ray to show.
struct Sights {
  bool alike = true;          ///< true if all rays of one sight have the same radiance
  bool density_right = true;  ///< true if radiance_within() is right, so that mistakes are the
                              ///< path's
};

Seen see(Sight sight, bool caustic, Sights& sights) {
  const std::size_t rays = sight == Sight::glass ? sight_rays : 3;
  const Answer rows =
      probe("Lab 9.5 sights",
            {.n = static_cast<std::int64_t>(rays),
             .numbers = {{"sight", static_cast<double>(sight)}, {"caustic", caustic ? 1 : 0}}},
            {.rows = rays + 1, .columns = 3, .finite = false, .of = name_of(sight)});
  const std::vector<DensityPhoton> photons = photons_on_target(rows.seed);
  std::vector<DensityVec> seen_radiances = radiances(rows);
  const DensityVec within =
      density_within(photons, DensityVec(0), {0, 0, 1}, static_cast<double>(target_radius));
  sights.density_right = sights.density_right && same_radiance(seen_radiances.back(), within);
  seen_radiances.pop_back();
  Seen seen;
  const DensityVec first(first_mirror), second(second_mirror);
  if (sight == Sight::mirror || sight == Sight::mirrored_sky) seen.weight = first;
  if (sight == Sight::mirrors) seen.weight = first * second;
  seen.last_weight = sight == Sight::mirrors ? first : seen.weight;
  if (sight == Sight::glass) seen.weight = seen.last_weight = DensityVec(1 / 2.25);
  if (sight == Sight::sky || sight == Sight::mirrored_sky) {
    seen.around = DensityVec(sky);
  } else {
    seen.emitted = DensityVec(target_glow);
    seen.photons = photon_radiance_of_target(photons, target_wo(sight));
  }
  bool found = false;
  for (const DensityVec& value : seen_radiances) {
    // Glass reflects some rays, into nothing.
    if (sight == Sight::glass && value == DensityVec(0)) continue;
    if (!found) seen.is = value;
    found = true;
    sights.alike = sights.alike && same_radiance(value, seen.is);
  }
  return seen;
}

std::vector<DensityVec> of_each(const std::vector<Seen>& all, DensityVec (*value)(const Seen&)) {
  std::vector<DensityVec> values;
  for (const Seen& seen : all)
    values.push_back(value(seen));
  return values;
}

std::vector<Reading> sight_readings(const std::vector<Seen>& all) {
  const auto reading = [&](const Diagnosis& diagnosis, DensityVec (*value)(const Seen&)) {
    return Reading{diagnosis, of_each(all, value)};
  };
  return {reading(sight_emission_missing,
                  [](const Seen& s) { return s.weight * (s.photons + s.around); }),
          reading(sight_photons_missing,
                  [](const Seen& s) { return s.weight * (s.emitted + s.around); }),
          reading(mirror_weight_missing,
                  [](const Seen& s) { return s.emitted + s.photons + s.around; }),
          reading(emission_unweighted,
                  [](const Seen& s) { return s.emitted + s.weight * (s.photons + s.around); }),
          reading(photons_unweighted,
                  [](const Seen& s) { return s.photons + s.weight * (s.emitted + s.around); }),
          reading(last_weight_only,
                  [](const Seen& s) { return s.last_weight * (s.emitted + s.photons + s.around); }),
          reading(mirrored_emission_lost,
                  [](const Seen& s) {
                    const DensityVec emitted =
                        s.weight == DensityVec(1) ? s.emitted : DensityVec(0);
                    return s.weight * (emitted + s.photons + s.around);
                  }),
          reading(sky_missing, [](const Seen& s) { return s.weight * (s.emitted + s.photons); }),
          reading(sky_unweighted,
                  [](const Seen& s) { return s.weight * (s.emitted + s.photons) + s.around; })};
}

void judge_sights(bool caustic) {
  std::vector<Seen> all;
  std::vector<DensityVec> are, should;
  std::vector<std::string> names;
  Sights sights;
  for (int i = 0; i < static_cast<int>(Sight::count); ++i) {
    const auto sight = static_cast<Sight>(i);
    const Seen seen = see(sight, caustic, sights);
    all.push_back(seen);
    are.push_back(seen.is);
    should.push_back(seen.weight * (seen.emitted + seen.photons + seen.around));
    names.push_back(std::string("the radiance of ") +
                    (seen.around == DensityVec(0) ? "a glowing surface with photons, " : "") +
                    name_of(sight));
  }
  std::vector<Reading> readings;
  if (sights.density_right) {
    readings = sight_readings(all);
    std::vector<DensityVec> unscaled = should;
    unscaled[static_cast<std::size_t>(Sight::glass)] *= 2.25;
    readings.push_back({glass_as_flux, unscaled});
  }
  judge_radiances(are, should, names, readings);
  std::vector<Diagnosis> found;
  if (!caustic && !sights.alike && sights.density_right) found = {samples_beside};
  judge(is_so("the radiance of one ray, asked for several times", sights.alike,
              "not always the same",
              "always the same: nothing is random there, but for what glass does", found));
}

}  // namespace

TEST_CASE("Lab 9.5: a map of all photons is seen straight, in mirrors and through glass",
          "[lab09][ex5]") {
  judge_sights(false);
}

TEST_CASE("Lab 9.5: a map of caustics is seen straight, in mirrors and through glass",
          "[lab09][ex5]") {
  judge_sights(true);
}

}  // namespace lab09_density
