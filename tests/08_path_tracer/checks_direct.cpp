// Checks of exercises 8.1 and 8.2. Direct light: 100 000 estimates a lamp against closed forms and
// integrals, with theory's standard deviation. One estimate has a coefficient of variation up
// to 4.2 (the wall by directions): a bias of 12 % is caught there with power .999, 5 % at the
// rectangle.

#include "08_path_tracer/theory.h"
#include "grader/judge/figures.h"

#include <algorithm>
#include <array>
#include <set>

using namespace carlo::grader;
using namespace lab08_tests;

namespace {

const Diagnosis not_jittered{"rays-not-jittered",
                             "every ray goes through the same place of its stratum."};
const Diagnosis not_stratified{"rays-not-stratified",
                               "some strata have no ray and others several: each stratum's own "
                               "corner has to be added before dividing."};
const Diagnosis diagonal{"one-number-for-both-coordinates",
                         "across and down come from one random number: the rays lie on a "
                         "diagonal of their stratum."};
const Diagnosis not_averaged{"sum-not-averaged", "this is the sum: divide by the number of rays."};
const Diagnosis upside_down{"pixels-upside-down",
                            "y counts from the top, and so does the film's second coordinate."};

const Diagnosis no_cos_surface{"cosine-at-the-surface-missing",
                               "the cosine at the surface is missing."};
const Diagnosis no_cos_light{"cosine-at-the-light-missing",
                             "the cosine at the light is missing: a tilted piece of the light "
                             "covers less of the sky."};
const Diagnosis no_distance{"squared-distance-missing",
                            "the division by the squared distance is missing."};
const Diagnosis no_area{"light-area-missing",
                        "the division by the point's density, 1/area, is missing."};
const Diagnosis not_weighted{"light-choice-not-weighted",
                             "one of two lights was picked, with probability 1/2: divide by it."};
const Diagnosis wrong_side{"wrong-side-of-the-light",
                           "a light emits on the side of its normal alone."};
const Diagnosis no_shadow{"no-shadow-ray", "light comes through a screen."};
const Diagnosis hits_itself{"ray-meets-its-own-surface",
                            "nothing arrives: does the ray start on the surface itself? "
                            "world.leave() starts it beside."};
const Diagnosis missing_pi{"pi-missing",
                           "the value is pi times too small: the density of the direction is "
                           "cos/pi."};
const Diagnosis channels{"channels-mixed", "the three channels have to be kept apart."};

/// One ray is right; each one more or less is drawn as four standard deviations.
Figure strata_picture(std::size_t strata, const std::vector<double>& rays) {
  const std::vector<double> one(rays.size(), 1.0), sd(rays.size(), 0.25);
  Figure figure = tiles_figure(strata, rays, one, sd);
  figure.title = "Rays in each stratum of the pixel";
  figure.note = "Blank: one ray, as it should be.";
  return figure;
}

}  // namespace

TEST_CASE("Lab 8.1: one ray in every stratum of the pixel, uniform within it", "[lab08][ex1]") {
  std::vector<double> across, down;
  for (const int strata : {1, 3, 16}) {
    const auto k = static_cast<std::size_t>(strata);
    const Rows rows = probe("Lab 8.1 rays", {.n = strata, .numbers = {{"x", 5}, {"y", 6}}},
                            {.rows = k * k + 2, .columns = 2});
    std::set<std::pair<int, int>> met;
    std::vector<double> rays(k * k);
    double corner = 0, same = 0;
    bool mirrored = true;
    for (std::size_t i = 0; i < k * k; ++i) {
      const double u = rows.at(i, 0) * strata, v = rows.at(i, 1) * strata;
      if (u >= -1e-4 && u < strata + 1e-4 && v >= -1e-4 && v < strata + 1e-4) {
        met.insert({static_cast<int>(u), static_cast<int>(v)});
        const int column = std::clamp(static_cast<int>(u), 0, strata - 1);
        const int row = std::clamp(static_cast<int>(v), 0, strata - 1);
        rays[static_cast<std::size_t>(row * strata + column)] += 1;
      }
      mirrored = mirrored && rows.at(i, 1) + 6 >= 1 - 1e-4 && rows.at(i, 1) + 6 <= 2 + 1e-4;
      across.push_back(u - std::floor(u));
      down.push_back(v - std::floor(v));
      corner += std::abs(across.back() - across[across.size() - i - 1]) < 1e-3 ? 1 : 0;
      same += std::abs(across.back() - down.back()) < 1e-3 ? 1 : 0;
    }
    const auto all = static_cast<double>(k * k);
    std::vector<Diagnosis> diagnoses;
    if (mirrored) diagnoses.push_back(upside_down);
    if (diagnoses.empty()) diagnoses.push_back(not_stratified);
    Verdict verdict =
        holds(fmt::format("strata of a pixel cut {} x {} that have a ray", strata, strata),
              met.size() == k * k, fmt::format("{} of {}", met.size(), k * k), "all", diagnoses);
    if (!verdict.passed && strata > 1) verdict.figure = strata_picture(k, rays);
    judge(verdict);
    if (strata == 16) {
      judge(holds("places in the strata", corner < all / 2 && same < all / 2,
                  corner >= all / 2 ? "all the same"
                  : same >= all / 2 ? "on a diagonal"
                                    : "spread",
                  "spread over them", {corner >= all / 2 ? not_jittered : diagonal}));
    }
  }
  judge(uniform_on("places across the strata", across, 0, 1));
  judge(uniform_on("places down the strata", down, 0, 1));
}

TEST_CASE("Lab 8.1: the mean of what the rays bring, each asked once", "[lab08][ex1]") {
  const Rows rows =
      probe("Lab 8.1 rays", {.n = 4, .numbers = {{"x", 0}, {"y", 7}}}, {.rows = 18, .columns = 2});
  judge(equals("rays", rows.at(17, 1), 16, 0));
  judge(equals("the mean of 1, 2, ... 16", rows.at(16, 0), 8.5, 1e-5, {{136, not_averaged}}));
  judge(
      equals("the mean of 1^2, 2^2, ... 16^2", rows.at(17, 0), 93.5, 1e-4, {{1496, not_averaged}}));
}

namespace {

struct LampCase {
  Lamp lamp;
  const char* name;
  double E;  ///< irradiance for radiance 1, in closed form
  Moments area;
};

std::vector<LampCase> lamps() {
  // Square over its centre: four corner squares of side 1/2 at height 1.
  const double a = 0.5, corner = std::atan(a / std::sqrt(1 + a * a)) * a / std::sqrt(1 + a * a);
  const double square = 4 * corner,
               wall = 0.5 * (std::atan(1.0) - std::atan(1 / std::sqrt(2.0)) / std::sqrt(2.0));
  const double cosine = std::cos(50 * pi / 180), x = std::sqrt(3.0), sine = std::sin(50 * pi / 180);
  const double y = -x * cosine / sine;
  const double sphere = cosine >= 0.5
                            ? pi * cosine / 4
                            : (cosine * std::acos(y) - x * sine * std::sqrt(1 - y * y)) / 4 +
                                  std::atan(sine * std::sqrt(1 - y * y) / x);
  return {{Lamp::rectangle, "a square lamp", square, by_area(Lamp::rectangle)},
          {Lamp::disk, "a round lamp", pi / 2, by_area(Lamp::disk)},
          {Lamp::sphere, "a ball", sphere, by_area(Lamp::sphere)},
          {Lamp::wall, "a shining wall", wall, by_area(Lamp::wall)},
          {Lamp::covered, "a lamp half hidden", square / 2, by_area(Lamp::covered)}};
}

Rows estimates(Lamp lamp, int form) {
  return probe(
      "Lab 8.2 estimates",
      {.n = 100'000,
       .numbers = {{"lamp", static_cast<double>(lamp)}, {"form", static_cast<double>(form)}}},
      {.rows = 100'000, .columns = 3});
}

/// Lamps emit (1, 2, 4): each estimate must have its channels so.
void judge_channels(const std::string& what, const Rows& rows) {
  std::size_t wrong = 0;
  for (std::size_t i = 0; i < rows.count(); ++i) {
    const double r = rows.at(i, 0);
    if (!(std::abs(rows.at(i, 1) - 2 * r) <= 1e-5 * r &&
          std::abs(rows.at(i, 2) - 4 * r) <= 1e-5 * r))
      ++wrong;
  }
  judge(holds("red, green and blue of " + what, wrong == 0,
              fmt::format("{} estimates not 1 : 2 : 4", wrong), "1 : 2 : 4, as the lamp emits",
              {channels}));
}

Moments two_lamps() {
  // Halves of the square: values of `rectangle` with radiance 1 or 3 and half the area, chosen
  // evenly.
  const Moments m = by_area(Lamp::rectangle);
  return {2 * m.mean, 5 * m.square};
}

}  // namespace

TEST_CASE("Lab 8.2: direct light by area", "[lab08][ex2]") {
  for (const LampCase& c : lamps()) {
    const Rows rows = estimates(c.lamp, 0);
    const double exact = 0.5 * c.E / pi;
    Suspects suspects{{by_area(c.lamp, Slip::cos_surface).mean, no_cos_surface},
                      {by_area(c.lamp, Slip::cos_light).mean, no_cos_light},
                      {by_area(c.lamp, Slip::distance).mean, no_distance},
                      {0, hits_itself}};
    if (c.lamp == Lamp::disk || c.lamp == Lamp::sphere) {
      suspects.push_back({by_area(c.lamp, Slip::area).mean, no_area});
    }
    if (c.lamp == Lamp::covered) suspects.push_back({2 * exact, no_shadow});
    judge(mean_is("light by area from " + std::string(c.name), column(rows, 0),
                  {exact, c.area.sd()}, suspects));
    if (c.lamp == Lamp::disk) judge_channels("light by area", rows);
  }
}

TEST_CASE("Lab 8.2: one of several lights by area", "[lab08][ex2]") {
  const Moments m = two_lamps();
  judge(mean_is("light by area from two lamps", column(estimates(Lamp::two, 0), 0), m.theory(),
                {{m.mean / 2, not_weighted}}));
}

TEST_CASE("Lab 8.2: lights shine to one side, and no light is dark", "[lab08][ex2]") {
  for (const int form : {0, 1}) {
    for (const Lamp lamp : {Lamp::behind, Lamp::none}) {
      const std::vector<double> red = column(estimates(lamp, form), 0);
      const bool dark = std::all_of(red.begin(), red.end(), [](double x) { return x == 0; });
      judge(
          holds(fmt::format("light {} {}", form == 0 ? "by area" : "by directions",
                            lamp == Lamp::none ? "without a lamp" : "from a lamp that faces away"),
                dark, "not 0", "0",
                lamp == Lamp::none ? std::vector<Diagnosis>{} : std::vector{wrong_side}));
    }
  }
}

TEST_CASE("Lab 8.2: the hemisphere form has the same mean", "[lab08][ex2]") {
  for (const LampCase& c : lamps()) {
    const Rows rows = estimates(c.lamp, 1);
    const double share = c.E / pi, exact = 0.5 * share;
    judge(mean_is("light by directions from " + std::string(c.name), column(rows, 0),
                  {exact, 0.5 * std::sqrt(share * (1 - share))},
                  {{exact / pi, missing_pi}, {0, hits_itself}}));
    if (c.lamp == Lamp::disk) judge_channels("light by directions", rows);
  }
}
