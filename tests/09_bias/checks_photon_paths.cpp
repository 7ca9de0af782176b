// Checks of exercise 9.4: photons among Phong surfaces. The right records of each photon are known.

#include "08_path_tracer/theory.h"
#include "09_bias/photon_trails.h"

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

namespace lab09_photons {

using namespace carlo::grader;

namespace {

const Diagnosis stored_late{
    "stored-after-reflection",
    "a photon is stored as it arrives, before what the surface does to it."};
const Diagnosis albedo_twice{"albedo-in-place-of-weight",
                             "sample() already absorbs photons: multiply by its weight, not by "
                             "the albedo."};
const Diagnosis weight_missing{"weight-missing",
                               "sample()'s weight is missing: for a coloured surface the "
                               "probability of continuing is right for one channel only."};
const Diagnosis first_only{"first-surface-only",
                           "photons are stored only where they arrive first, not after a "
                           "reflection."};
const Diagnosis absorbed_lost{"absorbed-photon-not-stored",
                              "a photon that is absorbed has arrived, too: store it before you "
                              "call sample()."};
const Diagnosis direct_lost{
    "direct-photons-not-stored",
    "photons straight from a light source have to be stored, too: users of the map that do not "
    "want them check phong and specular."};
const Diagnosis wi_onwards{"wi-points-onwards",
                           "wi points to where the photon came from, against the ray."};
const Diagnosis wi_next{"wi-of-the-next-ray",
                        "wi is the direction in which the photon continues; it should point to "
                        "where it came from."};
const Diagnosis photon_self_hit{"ray-meets-its-own-surface",
                                "photons are stored repeatedly at one point: a ray that starts "
                                "on a surface hits it again; world.leave() offsets its origin."};
const Diagnosis lobe_lost{
    "wo-points-onwards",
    "only the diffuse part is reflected: sample() needs wo, which points back along the ray; the "
    "lobe surrounds its mirror direction."};
const Diagnosis lobe_number{
    "random-number-reused",
    "the number that chooses the lobe is used for the direction, too: large parts of the "
    "hemisphere are never reached."};

// The closed sphere -------------------------------------------------------------------------------

/// Flux is multiplied by this at each reflection; the probability to continue is the red albedo.
PhotonVec closed_weight() {
  const PhotonVec albedo(closed_albedo);
  return albedo / albedo.r;
}

/// Directions there follow from the points, and so from the photons themselves. Points are rounded
/// and a photon starts slightly beside its own, 1.4e-6 in all: for two points close together, as
/// after one reflection in 1e7, that is no small part of their distance.
Stored in_closed(const Trail& trail, std::size_t i, std::size_t k) {
  const PhotonVec p = trail.stored[k].p;
  const PhotonVec from =
      k == 0 ? PhotonVec(sent_ray(PhotonPlace::closed, static_cast<std::int64_t>(i)).o)
             : trail.stored[k - 1].p;
  const double distance = glm::length(from - p);
  return {2.0 * glm::normalize(p),
          glm::normalize(from - p),
          sent * glm::pow(closed_weight(), PhotonVec(static_cast<double>(k))),
          static_cast<double>(k),
          0,
          std::max(1e-3, 1e-5 / distance)};
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

/// True if the first record is at the second arrival: off the ray that was sent, and with a count
/// of one.
bool direct_is_missing(const std::vector<Trail>& all) {
  double some = 0, second = 0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (all[i].stored.empty()) continue;
    const carlo::Ray ray = sent_ray(PhotonPlace::closed, static_cast<std::int64_t>(i));
    const Stored& first = all[i].stored.front();
    const PhotonVec way = first.p - PhotonVec(ray.o), d(ray.d);
    some += 1;
    second += first.phong == 1 && glm::length(way - glm::dot(way, d) * d) > 1e-3 ? 1 : 0;
  }
  return second > 0.99 * some;
}

/// True if photons are stored twice in one place.
bool photons_meet_themselves(const std::vector<Trail>& all) {
  double twice = 0;
  for (const Trail& trail : all) {
    for (std::size_t k = 1; k < trail.stored.size(); ++k)
      twice += glm::length(trail.stored[k].p - trail.stored[k - 1].p) <= 1e-4 ? 1 : 0;
  }
  return twice > 10;
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
  // The number of arrivals is geometric, with probability q to continue.
  const auto q = static_cast<double>(closed_albedo.r);
  Verdict verdict =
      mean_is("red flux stored in a sphere of albedo .6, all bounces, of each sent", red,
              {1 / (1 - q), std::sqrt(q) / (1 - q)},
              {{1, first_only}, {q / (1 - q), absorbed_lost}, {1 / (1 - q * q), albedo_twice}});
  const std::vector<Trail> all = trails(PhotonPlace::closed, "a closed sphere", 2'000);
  if (!verdict.passed && photons_meet_themselves(all)) verdict.diagnoses = {photon_self_hit};
  if (!verdict.passed && direct_is_missing(all)) verdict.diagnoses = {direct_lost};
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
    // From a point inside a sphere, cosine-weighted directions reach all other points equally:
    // their heights above it, along its normal, are uniform.
    if (trail.stored.size() > 1)
      second.push_back(glm::dot(trail.stored[1].p, glm::normalize(trail.stored[0].p)));
  }
  // If first photons are missing, others are in their places.
  const auto unless_missing =
      [missing = direct_is_missing(all)](const std::vector<Diagnosis>& diagnoses) {
        return missing ? std::vector{direct_lost} : diagnoses;
      };
  judge_none("photons of which nothing is stored", nothing, photons,
             unless_missing({absorbed_lost}));
  judge_none("photons off the sphere", differ.p, differ.all, {});
  judge_none("photons whose wi points elsewhere", differ.wi, differ.all,
             unless_missing(of_closed_wi(all)));
  judge_none("photons with a wrong flux", differ.flux, differ.all,
             unless_missing(of_closed_flux(all)));
  judge_none("photons with a wrong count of Phong surfaces", differ.phong, differ.all,
             unless_missing(of_counts(all)));
  judge_none("photons with a wrong count of mirrors and glass", differ.specular, differ.all, {});
  if (second.empty()) {
    judge(holds("photons after a first reflection", false, "none", "six in ten", {first_only}));
    return;
  }
  Verdict verdict =
      uniform_on("where photons go from a sphere's inside, along the normal there", second, -2, 2);
  if (!verdict.passed)
    verdict.diagnoses = {photons_meet_themselves(all) ? photon_self_hit : lobe_number};
  judge(verdict);
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
  judge(mean_is("flux that a glossy floor reflects, of each arriving", reflected, {albedo, sd},
                {{static_cast<double>(glossy_floor.kd), lobe_lost}}));
}

TEST_CASE("Lab 9.4: paths without an end are cut off", "[lab09][ex4]") {
  const auto count = [](PhotonPlace place, const std::string& name) {
    return trails(place, name, 1).front().count;
  };
  constexpr double longest = 1 << 16;
  const double white = count(PhotonPlace::white, "a sphere that absorbs nothing");
  judge(holds("photons stored of one in a white sphere", white <= longest && white > longest / 2,
              fmt::format("{:g}", white), "65536: lab08::longest_path"));
  judge(is_so("photons stored in a sphere of mirror",
              count(PhotonPlace::hall, "a hall of mirrors") == 0, "some",
              "none, after lab08::longest_path segments"));
}

}  // namespace lab09_photons
