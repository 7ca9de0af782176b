// Checks of exercise 9.7, make_record() and record_error(). What a record computes from its
// directions is exact; the directions themselves are judged by their distribution, 4000 of them: a
// mean that is off by .07 is detected with power .999.

#include "09_bias/irradiance_theory.h"
#include "grader/judge/judge.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

using namespace carlo::grader;
using namespace lab09_tests;

namespace {

constexpr double pi97 = std::numbers::pi;
const Unsaid unsaid97{"around", "normal", "scale", "strata"};

namespace record_slips {

const Diagnosis pi_missing{"pi-missing",
                           "E is pi times too small: the density of the directions is cos/pi, and "
                           "its cosine alone cancels."};
const Diagnosis uniform_density{"uniform-density",
                                "directions are cosine-weighted; their density is not that of "
                                "uniform ones, 1/(2 pi)."};
const Diagnosis cosine_twice{"cosine-twice",
                             "the cosine is in the density of the directions already: it cancels."};
const Diagnosis not_averaged{"not-averaged",
                             "a sum is not divided by the number of directions, strata^2."};
const Diagnosis by_strata{"divided-by-strata",
                          "there are strata^2 directions: that is what a mean is divided by."};
const Diagnosis arithmetic{
    "arithmetic-mean-distance",
    "the distances themselves are averaged. The harmonic mean is one over the mean of 1/d."};
const Diagnosis not_inverted{"mean-of-inverses", "the mean of 1/d is given, not one over it."};
const Diagnosis skipped{"infinite-distances-not-counted",
                        "rays that meet nothing count as well: their 1/d is 0, and they are "
                        "included in the number."};
const Diagnosis nearest{"nearest-distance", "the nearest distance is given, not the mean."};
const Diagnosis geometric{"geometric-mean-distance",
                          "the geometric mean of the distances is given, not the harmonic one."};
const Diagnosis cosine_in_mean{"distances-weighed-by-cosines",
                               "directions are already cosine-weighted; do not weight the "
                               "distances again."};
const Diagnosis open_sky{"open-sky",
                         "if no ray meets anything the harmonic mean is infinite, and the record "
                         "can be used everywhere."};
const Diagnosis channels_mixed{"channels-mixed", "the three channels have to be kept apart."};
const Diagnosis swapped{"point-and-normal",
                        "a record keeps the point and the normal it was made at."};
const Diagnosis not_turned{"direction-not-turned",
                           "directions point below the horizon: those of Lab 7.4 are around z, "
                           "and a frame of n (Lab 7.1) transforms them."};
const Diagnosis uniform_directions{"uniform-directions",
                                   "directions are uniform on the hemisphere: the mean cosine is "
                                   "1/2, of cosine-weighted ones 2/3."};
const Diagnosis number_reused{"number-reused",
                              "u.x and u.y are not independent: each needs a number of its own."};
const Diagnosis not_stratified{
    "not-stratified",
    "records vary as if their directions were independent: there should be one direction for "
    "each stratum (column, row) of the square, at its own random place."};
const Diagnosis not_jittered{"not-jittered",
                             "the directions are the same every time: the point in a stratum is "
                             "random, not its middle or its corner."};
const Diagnosis wrong_count{"directions-not-strata-squared",
                            "strata x strata directions, one in each stratum."};
const Diagnosis digits{"dot-product-rounded",
                       "for similar normals 1 - n . n' is lost to rounding: n . n' is a float "
                       "close to 1. |n - n'|^2/2 is the same and has all its digits."};
const Diagnosis dot_above_one{"dot-product-above-one",
                              "n . n' may be rounded to more than 1, and the root of a negative "
                              "number is NaN. |n - n'|^2/2 cannot be negative."};

}  // namespace record_slips

struct MadeRecord {
  std::vector<Double3> directions;
  Double3 E;
  double distance, calls;
  bool keeps_place;
};

MadeRecord made_record(Around around, std::size_t normal, int strata, double scale) {
  const auto count = static_cast<std::size_t>(strata) * static_cast<std::size_t>(strata);
  const Rows rows = probe("Lab 9.7 record",
                          {.n = strata,
                           .numbers = {{"around", static_cast<double>(around)},
                                       {"normal", static_cast<double>(normal)},
                                       {"scale", scale}}},
                          {.rows = count + 3,
                           .columns = 3,
                           .finite = false,
                           .of = fmt::format("{} x {} strata", strata, strata)});
  MadeRecord made{{}, {}, rows.at(count + 1, 0), rows.at(count + 1, 1), false};
  for (std::size_t i = 0; i < count; ++i)
    made.directions.emplace_back(rows.at(i, 0), rows.at(i, 1), rows.at(i, 2));
  made.E = {rows.at(count, 0), rows.at(count, 1), rows.at(count, 2)};
  made.keeps_place = rows.at(count + 2, 0) == 1 && rows.at(count + 2, 1) == 1;
  return made;
}

/// Sums over the directions of a record.
struct RecordSums {
  Double3 radiance{0}, with_cosine{0};
  double inverses = 0, distances = 0, finite = 0, logarithms = 0, least = endless, cosines = 0,
         lowest = 1, with_cosines = 0;

  RecordSums(const MadeRecord& made, Around around, Double3 n, double scale) {
    for (const Double3 wi : made.directions) {
      const Arrived a = arrived(around, n, wi, scale);
      const double cosine = glm::dot(n, wi);
      radiance += Double3(Rgb(a.radiance));
      with_cosine += cosine * Double3(Rgb(a.radiance));
      inverses += 1 / a.distance;
      with_cosines += cosine / a.distance;
      cosines += cosine;
      distances += a.distance;
      logarithms += std::log(a.distance);
      finite += std::isinf(a.distance) ? 0 : 1;
      least = std::min(least, a.distance);
      lowest = std::min(lowest, cosine);
    }
  }
};

Suspects irradiance_suspects(const RecordSums& sums, double count, int channel) {
  const double right = pi97 / count * sums.radiance[channel],
               cosine = pi97 / count * sums.with_cosine[channel];
  return {{right / pi97, record_slips::pi_missing},
          {right * 2, record_slips::uniform_density},
          {cosine, record_slips::cosine_twice},
          {cosine * 2, record_slips::uniform_density},
          {cosine / pi97, record_slips::cosine_twice},
          {right * count, record_slips::not_averaged},
          {right * std::sqrt(count), record_slips::by_strata},
          {right / pi97 / pi97, record_slips::pi_missing}};
}

/// Suspects for one over the distance, which is finite even if the distance is not.
Suspects distance_suspects(const RecordSums& sums, double count) {
  const double right = sums.inverses / count;
  return {{count / sums.distances, record_slips::arithmetic},
          {sums.finite / sums.distances, record_slips::arithmetic},
          {1 / right, record_slips::not_inverted},
          {right * count, record_slips::not_averaged},
          {right * std::sqrt(count), record_slips::by_strata},
          {sums.inverses / sums.finite, record_slips::skipped},
          {1 / sums.least, record_slips::nearest},
          {std::exp(-sums.logarithms / count), record_slips::geometric},
          {sums.with_cosines / sums.cosines, record_slips::cosine_in_mean},
          {sums.with_cosines / count, record_slips::cosine_in_mean},
          {right / count, record_slips::not_averaged}};
}

void judge_record(Around around, std::size_t normal, int strata, double scale,
                  const std::string& name) {
  const MadeRecord made = made_record(around, normal, strata, scale);
  const auto count = static_cast<double>(made.directions.size());
  const Double3 n(record_normals()[normal]);
  const RecordSums sums(made, around, n, scale);
  judge(equals("directions, " + name, made.calls, count, 0,
               {{std::sqrt(count), record_slips::wrong_count}}));
  judge(is_so("the lowest direction, " + name, sums.lowest >= -1e-5,
              fmt::format("{:.3g} below the horizon", -sums.lowest), "above the horizon",
              {record_slips::not_turned}));
  if (made.calls != count || sums.lowest < -1e-5) return;
  for (const int channel : {0, 1, 2}) {
    const double right = pi97 / count * sums.radiance[channel];
    judge(equals(fmt::format("{} of E, {}",
                             channel == 0   ? "red"
                             : channel == 1 ? "green"
                                            : "blue",
                             name),
                 made.E[channel], right, 1e-5 * right, irradiance_suspects(sums, count, channel)));
  }
  judge(is_so("where it was made, " + name, made.keeps_place, "elsewhere, or turned",
              "the point and the normal", {record_slips::swapped}));
  const double inverse = sums.inverses / count;
  if (inverse == 0) {
    std::vector<Diagnosis> diagnoses = {record_slips::open_sky};
    if (made.distance == 0) diagnoses.push_back(record_slips::not_inverted);
    judge(is_so("the distance, " + name, made.distance == endless, number_in_report(made.distance),
                "infinity", diagnoses));
    return;
  }
  judge(equals("one over the distance, " + name, 1 / made.distance, inverse, 1e-5 * inverse,
               distance_suspects(sums, count)));
}

/// Means of many records' directions along the normal and two tangents.
struct Directions97 {
  std::vector<double> along_n, along_s, along_t, inverse, calls;

  /// True if all records had the same directions.
  bool identical() const {
    for (const auto* means : {&along_n, &along_s, &along_t}) {
      for (const double mean : *means) {
        if (!(std::abs(mean - means->front()) < 1e-7)) return false;
      }
    }
    return true;
  }
};

Directions97 many_records(Around around, std::size_t normal, int strata, std::int64_t count) {
  const Rows rows = probe("Lab 9.7 records",
                          {.n = count,
                           .numbers = {{"around", static_cast<double>(around)},
                                       {"normal", static_cast<double>(normal)},
                                       {"scale", 1},
                                       {"strata", static_cast<double>(strata)}}},
                          {.rows = static_cast<std::size_t>(count),
                           .columns = 5,
                           .finite = false,
                           .of = fmt::format("{} records", count)});
  return {column(rows, 0), column(rows, 1), column(rows, 2), column(rows, 3), column(rows, 4)};
}

double mean97(const std::vector<double>& values) {
  double sum = 0;
  for (const double x : values)
    sum += x / static_cast<double>(values.size());
  return sum;
}

double mean_square_about97(const std::vector<double>& values, double mean) {
  double sum = 0;
  for (const double x : values)
    sum += (x - mean) * (x - mean) / static_cast<double>(values.size());
  return sum;
}

}  // namespace

TEST_CASE("Lab 9.7: a record holds irradiance and the harmonic mean of the distances",
          "[lab09][ex7]") {
  judge_record(Around::room, 5, 3, 1, "a room");
  judge_record(Around::room, 6, 8, 1e-4, "a tiny room");
  judge_record(Around::room, 7, 5, 1e6, "a huge room");
  judge_record(Around::half_open, 2, 8, 1, "half under the sky");
  judge_record(Around::open, 4, 4, 1, "under the sky");
  judge_record(Around::ceiling, 1, 1, 1, "one direction");
}

TEST_CASE("Lab 9.7: a record's directions are cosine-weighted around the normal", "[lab09][ex7]") {
  bool around = true;
  for (std::size_t normal = 0; normal < record_normals().size(); ++normal) {
    const Double3 n(record_normals()[normal]);
    const MadeRecord made = made_record(Around::ceiling, normal, 16, 1);
    Double3 mean(0);
    for (const Double3 wi : made.directions)
      mean += wi / static_cast<double>(made.directions.size());
    const double along = glm::dot(mean, n), off = glm::length(mean - 2 / 3.0 * n);
    std::vector<Diagnosis> diagnoses;
    if (std::abs(along - 0.5) < 0.03 && glm::length(mean - along * n) < 0.1)
      diagnoses.push_back(record_slips::uniform_directions);
    if (along < 0.45 && made.calls == 256) diagnoses.push_back(record_slips::not_turned);
    judge(
        holds(fmt::format("mean direction for the normal ({:.3g}, {:.3g}, {:.3g})", n.x, n.y, n.z),
              off < 0.12, fmt::format("({:.3g}, {:.3g}, {:.3g})", mean.x, mean.y, mean.z),
              "two thirds of the normal, within .12", diagnoses));
    around = around && off < 0.12;
  }
  if (!around) return;
  const Directions97 one = many_records(Around::ceiling, 5, 1, 4000);
  std::vector<double> squares, turns;
  for (std::size_t i = 0; i < one.along_n.size(); ++i) {
    squares.push_back(one.along_n[i] * one.along_n[i]);
    turns.push_back(std::atan2(one.along_t[i], one.along_s[i]));
  }
  // For uniform directions cos itself is uniform, so that cos^2 has the mean 1/3.
  judge(mean_is("squared cosine of single directions", squares, {0.5, std::sqrt(1 / 12.0)},
                {{1 / 3.0, record_slips::uniform_directions}}));
  for (const auto* tangent : {&one.along_s, &one.along_t}) {
    Verdict verdict = mean_is("single directions along a tangent", *tangent, {0, 0.5});
    if (!verdict.passed)
      verdict.diagnoses = {one.identical() ? record_slips::not_jittered
                                           : record_slips::number_reused};
    judge(verdict);
  }
  judge(uniform_on("azimuths of single directions", turns, -pi97, pi97));
}

TEST_CASE("Lab 9.7: a record's directions are stratified", "[lab09][ex7]") {
  // Independent directions would have variances of 1/18 and 1/4 over their number; strata have less
  // than a fifth of that, however Lab 7.4 maps the square. 96 records: chance changes a variance by
  // 15 %.
  constexpr double directions = 256;
  const Directions97 many = many_records(Around::ceiling, 6, 16, 96);
  judge(is_so("directions of two records", !many.identical(), "the same", "different ones",
              {record_slips::not_jittered}));
  // Wrong directions are not due to the strata.
  std::vector<Diagnosis> diagnoses;
  if (many.calls.front() != directions) {
    diagnoses = {record_slips::wrong_count};
  } else if (std::abs(mean97(many.along_n) - 2 / 3.0) < 0.02) {
    diagnoses = {record_slips::not_stratified};
  }
  const auto spread = [&](const char* of, const std::vector<double>& means, double mean,
                          double independent) {
    const double ratio = mean_square_about97(means, mean) * directions / independent;
    judge(holds(fmt::format("variance of the mean direction along {}", of), ratio < 0.4,
                fmt::format("{:.2g} of that of independent directions", ratio),
                "less than .4 of it", diagnoses));
  };
  spread("the normal", many.along_n, 2 / 3.0, 1 / 18.0);
  spread("a tangent", many.along_s, 0, 1 / 4.0);
  spread("the other tangent", many.along_t, 0, 1 / 4.0);
}

TEST_CASE("Lab 9.7: harmonic mean distances in closed form", "[lab09][ex7]") {
  // Under a ceiling at height 1 all 1/d are cosines z, 2/3 on average. In a ball of radius 2, where
  // d = sqrt(z^2 + 3) - z: 1/d = (z + sqrt(z^2 + 3))/3. Cosine-weighted z have the density 2 z.
  constexpr std::int64_t records = 200;
  constexpr double independent = 16;
  judge(mean_is("one over the distance, under a ceiling at height 1",
                many_records(Around::ceiling, 4, 4, records).inverse,
                {2 / 3.0, std::sqrt(1 / 18.0 / independent)}));
  const double root = 2 / 3.0 * (8 - std::pow(3, 1.5));
  const double ball = (2 / 3.0 + root) / 3;
  // E[(z + sqrt(z^2 + 3))^2] = 2 E[z^2] + 3 + 2 E[z sqrt(z^2 + 3)]; the last one by Simpson's rule.
  double mixed = 0;
  for (int i = 0; i <= 200; ++i) {
    const double z = i / 200.0, weight = i == 0 || i == 200 ? 1 : i % 2 == 1 ? 4 : 2;
    mixed += weight / 600 * 2 * z * z * std::sqrt(z * z + 3);
  }
  const double square = (4 + 2 * mixed) / 9;
  judge(mean_is("one over the distance, in a ball",
                many_records(Around::ball, 7, 4, records).inverse,
                {ball, std::sqrt((square - ball * ball) / independent)}));
}

TEST_CASE("Lab 9.7: Ward's estimate of the error", "[lab09][ex7]") {
  const std::vector<ErrorCase> cases = error_cases();
  const Rows rows = probe("Lab 9.7 errors", {}, {.rows = cases.size(), .finite = false});
  const auto agrees = [&](std::size_t i, Slip97 slip) {
    const ErrorCase& c = cases[i];
    const double value = error97(c.record, c.p, c.n, slip);
    // A root of 1 - n . n' in double, for normals of length 1 in double, is right to 2e-8.
    return rows.at(i, 0) == value || std::abs(rows.at(i, 0) - value) <= 2e-8 + 2e-6 * value;
  };
  const auto all_agree = [&](Slip97 slip) {
    for (std::size_t i = 0; i < cases.size(); ++i) {
      if (!agrees(i, slip)) return false;
    }
    return true;
  };
  std::vector<Diagnosis> slip;
  for (const Told97& told : error_slips97()) {
    if (all_agree(told.slip)) slip.push_back(told.diagnosis);
  }
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const ErrorCase& c = cases[i];
    const double apart = glm::length(Double3(c.n) - Double3(c.record.n));
    std::vector<Diagnosis> diagnoses = slip;
    if (slip.empty() && apart < 0.05) diagnoses = {record_slips::digits};
    if (std::isnan(rows.at(i, 0))) diagnoses = {record_slips::dot_above_one};
    judge(holds(fmt::format("the error {:.4g} away of {:.4g}, turned by {:.2g}",
                            glm::length(Double3(c.p) - Double3(c.record.p)), c.record.distance,
                            2 * std::asin(std::min(apart / 2, 1.0))),
                agrees(i, Slip97::none), number_in_report(rows.at(i, 0)),
                number_in_report(error97(c.record, c.p, c.n, Slip97::none)), diagnoses));
  }
}
