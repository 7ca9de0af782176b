// Checks of exercise 9.4: photons on their way, in worlds where each that is stored is known.

#include "08_path_tracer/theory.h"
#include "09_bias/photon_checks.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

using namespace carlo::grader;
using namespace lab09_photons;

namespace {

const Diagnosis stored_late{
    "stored-after-reflection",
    "a photon is stored as it arrives, before what the surface does to it."};
const Diagnosis albedo_twice{"albedo-in-place-of-weight",
                             "sample() absorbs photons already: its weight is what is left to "
                             "multiply, not the albedo."};
const Diagnosis weight_missing{"weight-missing",
                               "sample()'s weight is missing: of a coloured surface the chance to "
                               "go on is right for one channel only."};
const Diagnosis first_only{"first-surface-only",
                           "photons are stored where they arrive first, and not after a "
                           "reflection."};
const Diagnosis absorbed_lost{"absorbed-photon-not-stored",
                              "a photon that is absorbed has arrived, too: store it before "
                              "sample() is asked."};
const Diagnosis wi_onwards{"wi-points-onwards",
                           "wi points to where the photon came from, against the ray."};
const Diagnosis wi_next{"wi-of-the-next-ray",
                        "wi is the direction in which the photon goes on; it should point to where "
                        "it came from."};
const Diagnosis counts_itself{"counts-the-surface-itself",
                              "phong and specular count what the photon met before: not the "
                              "surface where it is stored."};
const Diagnosis phong_not_counted{"phong-not-counted", "phong does not grow at Phong surfaces."};
const Diagnosis specular_not_counted{"specular-not-counted",
                                     "specular does not grow at mirrors or at glass."};
const Diagnosis counts_all{"phong-counts-mirrors", "phong counts mirrors and glass, too."};
const Diagnosis flag_not_count{"specular-is-a-flag", "specular is a count, not whether."};
const Diagnosis mirror_bright{"mirror-reflects-all",
                              "the mirror's reflectance is missing in the flux."};
const Diagnosis stored_on_mirror{"stored-on-mirrors",
                                 "photons are stored on mirrors or on glass, where no radiance can "
                                 "be made of them."};
const Diagnosis scaled_by_eta{"flux-scaled-by-eta",
                              "radiance is scaled by eta^2 where light is refracted, because its "
                              "solid angle changes; flux is not."};
const Diagnosis no_lamps{"lamps-store-nothing",
                         "photons that meet a lamp are lost: it is a surface like any other."};
const Diagnosis photon_self_hit{"ray-meets-its-own-surface",
                                "photons are stored again and again at one point: a ray that "
                                "starts on a surface meets it; world.leave() starts it beside."};
const Diagnosis lobe_number{
    "random-number-reused",
    "the number that chooses the lobe makes the direction, too: large parts "
    "of the hemisphere are never reached."};

constexpr std::size_t shown = 3;  ///< photons that the probe shows of each one sent

/// One photon that was stored.
struct Stored {
  PhotonVec p, wi, flux;
  double phong, specular;
};

/// What was stored of one photon sent.
struct Trail {
  std::vector<Stored> stored;  ///< the first `shown`
  double count = 0;
};

std::vector<Trail> trails(PhotonPlace place, const std::string& name, std::size_t photons) {
  const Rows rows = probe(
      "Lab 9.4 stored",
      {.n = static_cast<std::int64_t>(photons), .numbers = {{"place", static_cast<double>(place)}}},
      {.rows = shown * photons, .columns = 12, .of = name});
  std::vector<Trail> all(photons);
  for (std::size_t i = 0; i < photons; ++i) {
    Trail& trail = all[i];
    trail.count = rows.at(shown * i, 11);
    for (std::size_t k = 0; k < shown && static_cast<double>(k) < trail.count; ++k) {
      const std::size_t row = shown * i + k;
      trail.stored.push_back({vec(rows, row, 0), vec(rows, row, 3), vec(rows, row, 6),
                              rows.at(row, 9), rows.at(row, 10)});
    }
  }
  return all;
}

/// What photon number k of a trail should be.
using Expected = std::function<Stored(std::size_t trail, std::size_t k)>;

/// How many of the photons differ from what they should be, in each respect.
struct Differences {
  double p = 0, wi = 0, flux = 0, phong = 0, specular = 0, all = 0;

  Differences(const std::vector<Trail>& trails, const Expected& expected) {
    for (std::size_t i = 0; i < trails.size(); ++i) {
      for (std::size_t k = 0; k < trails[i].stored.size(); ++k) {
        const Stored &is = trails[i].stored[k], should = expected(i, k);
        all += 1;
        p += glm::length(is.p - should.p) <= 1e-3 ? 0 : 1;
        wi += glm::length(is.wi - should.wi) <= 1e-3 ? 0 : 1;
        flux += off(is.flux, should.flux) <= 1e-4 ? 0 : 1;
        phong += is.phong == should.phong ? 0 : 1;
        specular += is.specular == should.specular ? 0 : 1;
      }
    }
  }
};

/// Whether all photons that `which` holds for have what `has` says, and there are some.
bool photons_have(const std::vector<Trail>& trails,
                  const std::function<bool(const Stored&, std::size_t k)>& which,
                  const std::function<bool(const Stored&, std::size_t k)>& has) {
  double some = 0, right = 0;
  for (const Trail& trail : trails) {
    for (std::size_t k = 0; k < trail.stored.size(); ++k) {
      if (!which(trail.stored[k], k)) continue;
      some += 1;
      right += has(trail.stored[k], k) ? 1 : 0;
    }
  }
  return some > 0 && right == some;
}

void judge_none(const std::string& what, double count, double of,
                const std::vector<Diagnosis>& diagnoses) {
  judge(holds(what, count == 0, fmt::format("{:g} of {:g}", count, of), "0", diagnoses));
}

const PhotonVec sent(sent_flux);

bool any_photon(const Stored&, std::size_t) {
  return true;
}
auto photon_number_is(std::size_t number) {
  return [number](const Stored&, std::size_t k) { return k == number; };
}
auto photon_flux_is(PhotonVec flux) {
  return [flux](const Stored& s, std::size_t) { return off(s.flux, flux) <= 1e-4; };
}

// The closed sphere -------------------------------------------------------------------------------

/// Flux is multiplied by this at each reflection; the chance to go on is the red albedo.
PhotonVec closed_weight() {
  const PhotonVec albedo(closed_albedo);
  return albedo / albedo.r;
}

/// Directions there are known from the points, so from the photons themselves.
Stored in_closed(const Trail& trail, std::size_t i, std::size_t k) {
  const PhotonVec p = trail.stored[k].p;
  const PhotonVec from =
      k == 0 ? PhotonVec(sent_ray(PhotonPlace::closed, static_cast<std::int64_t>(i)).o)
             : trail.stored[k - 1].p;
  return {2.0 * glm::normalize(p), glm::normalize(from - p),
          sent * glm::pow(closed_weight(), PhotonVec(static_cast<double>(k))),
          static_cast<double>(k), 0};
}

std::vector<Diagnosis> of_closed_flux(const std::vector<Trail>& all) {
  const PhotonVec weight = closed_weight(), albedo(closed_albedo);
  if (photons_have(all, photon_number_is(0), photon_flux_is(sent * weight))) return {stored_late};
  if (photons_have(all, photon_number_is(1), photon_flux_is(sent))) return {weight_missing};
  if (photons_have(all, photon_number_is(1), photon_flux_is(sent * albedo))) return {albedo_twice};
  return {};
}

std::vector<Diagnosis> of_closed_wi(const std::vector<Trail>& all) {
  double onwards = 0, next = 0, some = 0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    for (std::size_t k = 0; k + 1 < all[i].stored.size(); ++k) {
      const Stored &is = all[i].stored[k], should = in_closed(all[i], i, k);
      some += 1;
      onwards += glm::length(is.wi + should.wi) <= 1e-3 ? 1 : 0;
      next += glm::length(is.wi - glm::normalize(all[i].stored[k + 1].p - is.p)) <= 1e-3 ? 1 : 0;
    }
  }
  if (onwards > 0.99 * some) return {wi_onwards};
  if (next > 0.99 * some) return {wi_next};
  return {};
}

/// Whether photons are stored twice in one place.
bool photons_meet_themselves(const std::vector<Trail>& all) {
  double twice = 0;
  for (const Trail& trail : all) {
    for (std::size_t k = 1; k < trail.stored.size(); ++k)
      twice += glm::length(trail.stored[k].p - trail.stored[k - 1].p) <= 1e-4 ? 1 : 0;
  }
  return twice > 10;
}

std::vector<Diagnosis> of_counts(const std::vector<Trail>& all) {
  if (photons_have(all, any_photon, [](const Stored& s, std::size_t k) {
        return s.phong == static_cast<double>(k + 1);
      }))
    return {counts_itself};
  if (photons_have(all, any_photon, [](const Stored& s, std::size_t) { return s.phong == 0; }))
    return {phong_not_counted};
  return {};
}

}  // namespace

TEST_CASE("Lab 9.4: power is conserved in a closed sphere", "[lab09][ex4]") {
  constexpr std::size_t photons = 20'000;
  const Rows rows =
      probe("Lab 9.4 sums",
            {.n = photons, .numbers = {{"place", static_cast<double>(PhotonPlace::closed)}}},
            {.rows = photons, .columns = 4, .of = "a closed sphere"});
  std::vector<double> red = column(rows, 0);
  for (double& value : red)
    value /= sent.r;
  // The number of arrivals is geometric, and the chance to go on q.
  const auto q = static_cast<double>(closed_albedo.r);
  Verdict verdict =
      mean_is("red flux stored in a sphere of albedo .6, all bounces, of each sent", red,
              {1 / (1 - q), std::sqrt(q) / (1 - q)},
              {{1, first_only}, {q / (1 - q), absorbed_lost}, {1 / (1 - q * q), albedo_twice}});
  const std::vector<Trail> all = trails(PhotonPlace::closed, "a closed sphere", 2'000);
  if (!verdict.passed && photons_meet_themselves(all)) verdict.diagnoses = {photon_self_hit};
  judge(verdict);
}

TEST_CASE("Lab 9.4: what is stored in a closed sphere", "[lab09][ex4]") {
  constexpr std::size_t photons = 8'000;
  const std::vector<Trail> all = trails(PhotonPlace::closed, "a closed sphere", photons);
  const Differences differ(all,
                           [&](std::size_t i, std::size_t k) { return in_closed(all[i], i, k); });
  double nothing = 0;
  std::vector<double> second;
  for (const Trail& trail : all) {
    nothing += trail.count >= 1 ? 0 : 1;
    // From one point of a sphere's inside, cosine-weighted directions reach all others alike.
    if (trail.stored.size() > 1) second.push_back(trail.stored[1].p.z);
  }
  judge_none("photons of which nothing is stored", nothing, photons, {absorbed_lost});
  judge_none("photons off the sphere", differ.p, differ.all, {});
  judge_none("photons whose wi points elsewhere", differ.wi, differ.all, of_closed_wi(all));
  judge_none("photons with a wrong flux", differ.flux, differ.all, of_closed_flux(all));
  judge_none("photons with a wrong count of Phong surfaces", differ.phong, differ.all,
             of_counts(all));
  judge_none("photons with a wrong count of mirrors and glass", differ.specular, differ.all, {});
  if (second.empty()) {
    judge(holds("photons after a first reflection", false, "none", "six in ten", {first_only}));
    return;
  }
  Verdict verdict = uniform_on("heights of photons after one reflection", second, -2, 2);
  if (!verdict.passed)
    verdict.diagnoses = {photons_meet_themselves(all) ? photon_self_hit : lobe_number};
  judge(verdict);
}

namespace {

// Mirrors and glass -------------------------------------------------------------------------------

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
  double within = 0, outside = 0, on_glass = 0, others = 0, specular = 0, flux = 0, stored = 0;
  for (const Trail& trail : all) {
    others += trail.count == 1 ? 0 : 1;
    for (const Stored& s : trail.stored) {
      const double r = glm::length(s.p);
      stored += 1;
      within += std::abs(r - 0.5) < 1e-3 ? 1 : 0;
      outside += std::abs(r - 3) < 1e-3 ? 1 : 0;
      on_glass += std::abs(r - 1) < 1e-3 ? 1 : 0;
      specular += s.specular == 1 && s.phong == 0 ? 0 : 1;
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
  // Glass reflects 4 % and a little more at these angles: none of 500 once in 1e9 times.
  judge(holds("photons within the glass and around it", within > 0 && outside > 0,
              fmt::format("{:g} and {:g}", within, outside), "some, and some"));
  judge_none("photons with wrong counts after glass", specular, stored,
             of_mirror_counts(all, on_glass > 0));
}

TEST_CASE("Lab 9.4: lamps and backs are surfaces", "[lab09][ex4]") {
  constexpr std::size_t photons = 100;
  const std::vector<Trail> all = trails(PhotonPlace::backs, "a lamp, and a black back", photons);
  double at_lamp = 0, at_back = 0;
  for (std::size_t i = 0; i < photons; ++i)
    (i % 2 == 0 ? at_lamp : at_back) += all[i].count == 1 ? 0 : 1;
  judge_none("photons that are not stored once on a lamp", at_lamp, photons / 2, {no_lamps});
  judge_none("photons that are not stored once on a black back", at_back, photons / 2, {});
  const Differences differ(all, [](std::size_t i, std::size_t) {
    const carlo::Ray ray = sent_ray(PhotonPlace::backs, static_cast<std::int64_t>(i));
    return Stored{PhotonVec(ray.o + ray.d), -PhotonVec(ray.d), sent, 0, 0};
  });
  judge_none("of these, photons with a wrong place or direction", differ.p + differ.wi, differ.all,
             {});
}

TEST_CASE("Lab 9.4: a glossy floor reflects its albedo", "[lab09][ex4]") {
  constexpr std::size_t photons = 20'000;
  const Rows rows =
      probe("Lab 9.4 sums",
            {.n = photons, .numbers = {{"place", static_cast<double>(PhotonPlace::glossy)}}},
            {.rows = photons, .columns = 4, .of = "a glossy floor"});
  std::vector<double> reflected = column(rows, 0);
  for (double& value : reflected)
    value = value / sent.r - 1;
  const auto degrees = static_cast<double>(glossy_degrees);
  const double sd = lab08_tests::PhongTheory(glossy_floor).weights(degrees).sd();
  const double albedo =
      static_cast<double>(glossy_floor.kd) +
      static_cast<double>(glossy_floor.ks) * lab08_tests::specular_albedo(50, degrees);
  judge(mean_is("flux that a glossy floor reflects, of each arriving", reflected, {albedo, sd}));
}

TEST_CASE("Lab 9.4: paths without an end are cut off", "[lab09][ex4]") {
  const auto count = [](PhotonPlace place, const std::string& name) {
    return trails(place, name, 1).front().count;
  };
  constexpr double longest = 1 << 16;
  const double white = count(PhotonPlace::white, "a sphere that absorbs nothing");
  judge(holds("photons stored of one in a white sphere", white <= longest && white > longest / 2,
              fmt::format("{:g}", white), "65536: lab08::longest_path"));
  judge(holds("photons stored in a sphere of mirror",
              count(PhotonPlace::hall, "a hall of mirrors") == 0, "some",
              "none, after lab08::longest_path segments"));
}
