// Checks of exercise 9.4: photons among mirrors and glass, on lights and on black backs.

#include "09_bias/photon_trails.h"

#include <cmath>
#include <vector>

namespace lab09_photons {

using namespace carlo::grader;

namespace {

const Diagnosis specular_not_counted{"specular-not-counted",
                                     "specular does not grow at mirrors or at glass."};
const Diagnosis counts_all{"phong-counts-mirrors", "phong counts mirrors and glass, too."};
const Diagnosis flag_not_count{
    "specular-is-a-flag",
    "specular counts all mirrors and glass of the path: it is not a flag, and is not reset at a "
    "Phong surface."};
const Diagnosis mirror_bright{"mirror-reflects-all",
                              "the mirror's reflectance is missing in the flux."};
const Diagnosis stored_on_mirror{"stored-on-mirrors",
                                 "photons are stored on mirrors or on glass, where no radiance "
                                 "can be computed from them."};
const Diagnosis scaled_by_eta{"flux-scaled-by-eta",
                              "radiance is scaled by eta^2 where light is refracted, because its "
                              "solid angle changes; flux is not."};
const Diagnosis no_lights{"lights-store-nothing",
                          "photons that hit a light are lost: it is a surface like any other."};

std::vector<Diagnosis> of_mirror_counts(const std::vector<Trail>& all, bool stored_at_mirrors) {
  if (stored_at_mirrors) return {stored_on_mirror};
  if (photons_have(all, any_photon, [](const Stored& s, std::size_t) { return s.specular == 0; }))
    return {specular_not_counted};
  if (photons_have(all, any_photon, [](const Stored& s, std::size_t) { return s.specular == 1; }))
    return {flag_not_count};
  return {};
}

}  // namespace

TEST_CASE("Lab 9.4: between a floor and a mirror", "[lab09][ex4]") {
  constexpr std::size_t photons = 500;
  const std::vector<Trail> all = trails(PhotonPlace::mirrors, "a floor and a mirror", photons);
  const PhotonVec reflectance(mirror_reflectance);
  const Differences differ(all, [&](std::size_t i, std::size_t k) {
    const carlo::Ray ray = sent_ray(PhotonPlace::mirrors, static_cast<std::int64_t>(i));
    const PhotonVec d(ray.d), o(ray.o);
    const auto bounces = static_cast<double>(k);
    Stored s = all[i].stored[k];
    s.p.z = 0;
    s.flux = sent * glm::pow(reflectance, PhotonVec(bounces + 1));
    s.phong = bounces;
    s.specular = bounces + 1;
    if (k == 0) s.p = o + d * (1.5 / d.z), s.p.z = 0, s.wi = {-d.x, -d.y, d.z};
    return s;
  });
  double at_mirror = 0;
  for (const Trail& trail : all) {
    for (const Stored& s : trail.stored)
      at_mirror += std::abs(s.p.z - 1) < 1e-3 ? 1 : 0;
  }
  const bool bright = photons_have(all, any_photon, photon_flux_is(sent));
  judge_none("photons elsewhere than on the floor", differ.p, differ.all,
             at_mirror > 0 ? std::vector{stored_on_mirror} : std::vector<Diagnosis>{});
  judge_none("photons whose wi points elsewhere than to the mirror", differ.wi, differ.all, {});
  judge_none("photons with a wrong flux after a mirror", differ.flux, differ.all,
             bright ? std::vector{mirror_bright} : std::vector<Diagnosis>{});
  judge_none("photons with a wrong count of mirrors", differ.specular, differ.all,
             of_mirror_counts(all, at_mirror > 0));
  const bool twice = photons_have(all, any_photon, [](const Stored& s, std::size_t k) {
    return s.phong == static_cast<double>(2 * k + 1);
  });
  judge_none("photons after mirrors with a wrong count of Phong surfaces", differ.phong, differ.all,
             twice ? std::vector{counts_all} : of_counts(all));
  judge(holds("photons stored", differ.all >= photons, fmt::format("{:g}", differ.all),
              fmt::format("at least {}", photons)));
}

TEST_CASE("Lab 9.4: through glass", "[lab09][ex4]") {
  constexpr std::size_t photons = 500;
  const std::vector<Trail> all = trails(PhotonPlace::glass, "a black ball in glass", photons);
  double within = 0, outside = 0, on_glass = 0, others = 0, specular = 0, phong = 0, flux = 0,
         stored = 0;
  for (const Trail& trail : all) {
    others += trail.count == 1 ? 0 : 1;
    for (const Stored& s : trail.stored) {
      const double r = glm::length(s.p);
      stored += 1;
      within += std::abs(r - 0.5) < 1e-3 ? 1 : 0;
      outside += std::abs(r - 3) < 1e-3 ? 1 : 0;
      on_glass += std::abs(r - 1) < 1e-3 ? 1 : 0;
      specular += s.specular == 1 ? 0 : 1;
      phong += s.phong == 0 ? 0 : 1;
      flux += off(s.flux, sent) <= 1e-4 ? 0 : 1;
    }
  }
  const auto in_ball = [](const Stored& s, std::size_t) { return glm::length(s.p) < 0.9; };
  const bool scaled = photons_have(all, in_ball, photon_flux_is(sent / 2.25)) ||
                      photons_have(all, in_ball, photon_flux_is(sent * 2.25));
  const std::vector<Diagnosis> at_glass =
      on_glass > 0 ? std::vector{stored_on_mirror} : std::vector<Diagnosis>{};
  judge_none("photons with a wrong flux in glass", flux, stored,
             scaled ? std::vector{scaled_by_eta} : std::vector<Diagnosis>{});
  judge_none("photons that are not stored once, on the black ball or around the glass",
             others + stored - within - outside, stored, at_glass);
  // Glass reflects 4 % and a little more at these angles: none of 500 happens once in 1e9 times.
  judge(holds("photons within the glass and around it", within > 0 && outside > 0,
              fmt::format("{:g} and {:g}", within, outside), "some, and some"));
  judge_none("photons with a wrong count of glass", specular, stored,
             of_mirror_counts(all, on_glass > 0));
  judge_none("photons after glass with a wrong count of Phong surfaces", phong, stored, {});
}

TEST_CASE("Lab 9.4: lights and backs are surfaces", "[lab09][ex4]") {
  constexpr std::size_t each = 50, photons = 2 * each;
  const std::vector<Trail> all = trails(PhotonPlace::backs, "a light, and a black back", photons);
  double at_light = 0, at_back = 0;
  for (std::size_t i = 0; i < photons; ++i)
    (i % 2 == 0 ? at_light : at_back) += all[i].count == 1 ? 0 : 1;
  judge_none("photons that are not stored once on a light", at_light, each,
             at_back == 0 ? std::vector{no_lights} : std::vector<Diagnosis>{});
  judge_none("photons that are not stored once on a black back", at_back, each, {});
  const Differences differ(all, [](std::size_t i, std::size_t) {
    const carlo::Ray ray = sent_ray(PhotonPlace::backs, static_cast<std::int64_t>(i));
    return Stored{PhotonVec(ray.o + ray.d), -PhotonVec(ray.d), sent, 0, 0};
  });
  judge_none("of these, photons with a wrong place or direction", differ.p + differ.wi, differ.all,
             {});
}

}  // namespace lab09_photons
