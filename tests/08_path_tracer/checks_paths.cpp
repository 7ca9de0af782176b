// Checks of exercise 8.8's paths: worlds with closed forms, 50 000 paths each.

#include "08_path_tracer/paths.h"

using namespace carlo::grader;
using namespace lab08_tests;

namespace {

const Diagnosis no_compensation{"roulette-without-compensation",
                                "roulette ends paths, but the survivors are not weighted: divide "
                                "by the survival probability."};
const Diagnosis multiplied{"roulette-multiplied",
                           "paths that survive roulette are multiplied by the survival "
                           "probability: they also stand for those that ended, so divide by it."};
const Diagnosis no_floor{"roulette-without-a-floor",
                         "paths of small throughput survive too rarely: use a probability of at "
                         "least 1/64, or the random number's steps decide."};
const Diagnosis other_chance{"roulette-by-the-other-chance",
                             "paths that survive roulette are divided by the probability of "
                             "ending: divide by the survival probability."};
const Diagnosis ended_dark{"ended-path-loses-light",
                           "a path that roulette ends contributes nothing at all: the radiance "
                           "gathered until then still counts."};
const Diagnosis sampled_per_area{
    "light-sampled-per-area",
    "a light's point is divided by its density per area: multiply by cos/distance^2 too, or turn "
    "the density into one per solid angle."};
const Diagnosis sampled_inverted{"multiplied-by-the-density",
                                 "light from a light's point is multiplied by the point's density, "
                                 "not divided."};
const Diagnosis both_whole{"techniques-not-weighted",
                           "both techniques count all of the direct light: their weights have to "
                           "add up to 1."};
const Diagnosis no_throughput{
    "throughput-missing-in-direct-light",
    "light from a light's point is not multiplied by the throughput of the path that found it."};
const Diagnosis others_weight{
    "weight-of-the-other-technique",
    "a technique is weighted by the other's share: a sample's own density stands in the "
    "numerator."};
const Diagnosis kept_across{
    "vertex-kept-across-mirror",
    "after a mirror or glass emission counts in full: no light was sampled there. Discard the "
    "previous surface and its density."};
const Diagnosis read_twice{"random-number-reused",
                           "one number is used for two decisions: seek() to the vertex's own "
                           "dimensions."};
const Diagnosis depth_slips{"depth-off-by-one",
                            "with max_depth = 1 a path sees only emission, with 2 also direct "
                            "light."};

Rows trace_all(Params params, double depth, bool finite = true) {
  params.numbers["depth"] = depth;
  const std::string length = depth == 0 ? "any length" : fmt::format("max_depth = {}", depth);
  return probe("Lab 8.8 paths", params,
               {.rows = paths,
                .columns = 6,
                .finite = finite,
                .of = fmt::format("{}, {}", length, view_text(params))});
}

/// The values of paths of any length in a furnace of albedo .5.
std::vector<double> in_whole_furnace() {
  return column(trace_all(furnace_of(0.5, 0.25), 0, false), 0);
}

bool all_are(const std::vector<double>& values, double value) {
  return std::all_of(values.begin(), values.end(), [=](double x) { return x == value; });
}

/// Judges paths in other worlds: a mistake that ends paths too early, or without their light, shows
/// in a furnace as well.
void judge_paths(Verdict verdict) {
  if (!verdict.passed) {
    const std::vector<double> values = in_whole_furnace();
    if (all_are(values, 0)) verdict.diagnoses = {absorbed_dark};
    if (all_are(values, 1)) verdict.diagnoses = {depth_slips};
  }
  judge(verdict);
}

/// The light from the square light source if the light's point is divided by `divisor` in place of
/// its density, and everything else is right: directions are cosine-weighted, half of them
/// absorbed.
template <class Divisor>
double light_divided_by(const Divisor& divisor) {
  double sum = 0;
  over_square(400, [&](double u, double v, double weight) {
    const Double3 p(u - 0.5, v - 0.5, 1);
    const double d2 = glm::dot(p, p), cosine = 1 / std::sqrt(d2);
    const double density = d2 / cosine, drawn = divisor(density), other = 0.5 * cosine / pi;
    const auto share = [](double a, double b) { return a * a / (a * a + b * b); };
    sum += weight * 0.5 / pi * cosine *
           (share(drawn, other) / drawn + share(other, density) / density);
  });
  return sum;
}

/// The mean of paths between mirrors of reflectance .6: throughput .6, .36, .216 ...; from the
/// third vertex on roulette is played, and `change` is what happens to the throughput of survivors.
template <class Change>
double between_mirrors(const Change& change) {
  double throughput = 1, alive = 1, mean = 0;
  for (int vertex = 0; vertex < 400; ++vertex) {
    mean += alive * throughput;
    throughput *= 0.6;
    const double survival = std::min(1.0, 4 * throughput);
    alive *= survival;
    if (survival < 1) throughput = change(throughput, survival);
  }
  return mean;
}

}  // namespace

TEST_CASE("Lab 8.8: closed forms, at every length of path", "[lab08][ex8]") {
  // Standard deviations are bounds: three halves of a right solution's (no closed form).
  for (const double depth : {1.0, 2.0, 3.0, 0.0}) {
    const Rows rows = trace_all(furnace_of(0.5, 0.25), depth);
    const double red = depth == 0 ? 2 : 2 * (1 - std::pow(0.5, depth));
    const double next = depth == 0 ? 2 : 2 * (1 - std::pow(0.5, depth + 1));
    const std::string name = depth == 0 ? "of any length" : fmt::format("of {:g} segments", depth);
    // All around, a light's point has the density cos/pi and a direction half of that: shares .8
    // and .2.
    Suspects suspects{{next, depth_slips}, {1 + 2 * (red - 1), both_whole}, {2 * red, both_whole}};
    if (depth != 1) {
      suspects.push_back({1 + 0.4 * (red - 1), others_weight});
      suspects.push_back({1 + 1.6 * (red - 1), others_weight});
    }
    judge_paths(mean_is("radiance in a furnace, paths " + name, column(rows, 0),
                        {red, depth == 1 ? 1e-3 : 1.5}, suspects));
    const std::vector<double> twice = column(rows, 3), film = column(rows, 4);
    const auto zero = [](const std::vector<double>& v) {
      return std::all_of(v.begin(), v.end(), [](double x) { return x == 0; });
    };
    if (depth == 0) {
      // Roulette undoes what a bounce does to the throughput in red, not in green.
      const double green = 4.0 / 3;
      judge_paths(mean_is("green radiance in a furnace, paths " + name, column(rows, 1),
                          {green, 1.5},
                          {{1 + 0.4 * (red - 1) + 0.2 * (green - 1), no_throughput}}));
      judge(is_so("random numbers of a path", zero(twice) && zero(film),
                  zero(twice) ? "some are the film's" : "some are read twice",
                  "each read once at most", {read_twice}));
    }
  }
}

TEST_CASE("Lab 8.8: a light, a glossy ball, glass", "[lab08][ex8]") {
  const double exact = 0.5 * light_path_share;
  const double per_area = light_divided_by([](double) { return 1.0; });
  const double inverted = light_divided_by([](double density) { return 1 / density; });
  judge_paths(mean_is(
      "light from a light source", column(trace_all(with(on_floor, {{"light", 0}}), 0), 0),
      {exact, 0.15},
      {{2 * exact, both_whole}, {per_area, sampled_per_area}, {inverted, sampled_inverted}}));
  const std::vector<double> ball = column(trace_all(ball_of(glossy), 0), 0);
  judge_paths(mean_is("a glossy ball under the sky", ball, ball_theory(),
                      all_are(ball, 0) ? Suspects{{0, sky_missing}} : Suspects{}));
  judge_paths(mean_is(
      "radiance in a furnace around a glass ball",
      column(trace_all(with(with_glass, {{"r", 0.5}, {"g", 0.5}, {"b", 0.5}}), 0), 0), {2, 2}));
}

TEST_CASE("Lab 8.8: a weak light beside a far, strong sun", "[lab08][ex8]") {
  // rho/pi (3 + 3) with rho = 1/2. The sd is a bound, a quarter more than that of light by area
  // alone: directions rarely meet what a light's point does not, and have small weights there.
  const std::vector<double> seen =
      column(trace_all(with(on_floor, {{"light", static_cast<double>(Light::weak)}}), 0), 0);
  judge_paths(mean_is("light from a light source and a sun", seen, {3 / pi, 6 / pi}));
}

TEST_CASE("Lab 8.8: a light in a mirror and behind glass, seen by a rough surface",
          "[lab08][ex8]") {
  // A path contributes the light's radiance 1 or nothing, and more than 1 if roulette might have
  // ended it: the sd is a bound, twice that of a path without roulette. Less than 1 means a weight:
  // that of the previous vertex leaves a fiftieth of the light, 18 standard errors too little.
  for (const Place place : {by_mirror, by_pane}) {
    const double exact = 0.5 * (place == by_mirror ? mirrored_share() : light_path_share);
    const std::vector<double> seen = column(trace_all(with(place, {}), 0, false), 0);
    Verdict verdict = mean_is(
        place == by_mirror ? "light from a light source in a mirror" : "light through a pane", seen,
        {exact, 2 * std::sqrt(exact)});
    // No comparison is true for NaN, and power_heuristic(0, 0) may well be NaN.
    const bool weighed =
        std::none_of(seen.begin(), seen.end(), [](double x) { return x >= 0.999; });
    if (!verdict.passed && weighed) verdict.diagnoses.push_back(kept_across);
    judge_paths(verdict);
  }
}

TEST_CASE("Lab 8.8: roulette ends paths and keeps the mean", "[lab08][ex8]") {
  const double none = between_mirrors([](double t, double) { return t; });
  const double times = between_mirrors([](double t, double q) { return t * q; });
  const std::vector<double> seen =
      column(trace_all(with(in_mirrors, {{"r", 0.6}, {"g", 0.6}, {"b", 0.6}}), 0), 0);
  Verdict verdict = mean_is("radiance in a furnace of mirrors of reflectance .6", seen, {2.5, 1.5},
                            {{none, no_compensation}, {times, multiplied}, {0, ended_dark}});
  // Values divided by the probability to end have no mean to be recognised by. The first roulette
  // is survived with probability .864; the next comes four vertices later, where the path has this
  // throughput.
  const double first = 1 + 0.6 + 0.36, won = 0.216 / (1 - 0.864);
  const double next = first + won * (1 + 0.6 + 0.36 + 0.216);
  const auto ends =
      std::count_if(seen.begin(), seen.end(), [=](double x) { return std::abs(x - next) < 1e-3; });
  if (!verdict.passed && ends > 10) verdict.diagnoses = {other_chance};
  judge_paths(verdict);
}

TEST_CASE("Lab 8.8: roulette lets one of 64 paths survive at least", "[lab08][ex8]") {
  // Between mirrors of reflectance .001 the paths that survive their first vertex see more than the
  // wall there. Of 50 000, 781 +- 28 do at 1/64, all do without roulette at that vertex; a right
  // solution has fewer than 622 once in 2e8 times, and 4 * .001 leaves 200.
  const double reflectance = 0.001;
  const std::vector<double> seen = column(
      trace_all(with(in_mirrors, {{"r", reflectance}, {"g", reflectance}, {"b", reflectance}}), 0),
      0);
  const auto alive =
      std::count_if(seen.begin(), seen.end(), [=](double x) { return x > 1 + reflectance / 2; });
  // Weights above 64 tell of a probability below a 64th.
  const bool heavy =
      std::any_of(seen.begin(), seen.end(), [=](double x) { return x > 1 + 65 * reflectance; });
  const bool enough = alive >= 622;
  judge_paths(holds("how many of 50 000 paths survive roulette at a throughput of .001", enough,
                    fmt::format("{}", alive), "781 (a 64th) or more",
                    !enough && heavy ? std::vector{no_floor} : std::vector<Diagnosis>{}));
}
