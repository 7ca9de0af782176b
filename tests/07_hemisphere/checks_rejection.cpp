// Checks of exercise 7.2. Chi-square over 256 cells of equal mass from 200 000 directions: cells
// off by 3.7 % each (rms) have a noncentrality of 270, which is detected with power .999. Accepting
// darts in the cube's corners gives a mean cosine of .5155 (for a normal along an axis), 24
// standard errors off 1/2, and loses no dart.

#include "07_hemisphere/law.h"
#include "grader/protocol/next_words.h"
#include "random/rng.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

using namespace carlo::grader;
using namespace lab07_tests;

namespace {

const Diagnosis corners{"corners-kept",
                        "the darts outside the ball are kept: directions crowd towards the cube's "
                        "corners."};
const Diagnosis octant{
    "one-octant-only",
    "all coordinates are positive: the cube runs from -1 to 1, not from 0 to 1."};
const Diagnosis below{"below-horizon-kept",
                      "directions below the horizon are returned: flip them."};
const Diagnosis thrown_away{
    "thrown-away-not-flipped",
    "twice as many darts as needed: use the opposite of a direction below the horizon."};
const Diagnosis accepted_not_counted{"accepted-dart-not-counted",
                                     "the dart that is accepted counts as well."};
const Diagnosis disc{"a-disc-not-a-ball", "darts are rejected by two of their coordinates only."};
const Diagnosis order_of_numbers{
    "order-of-the-numbers",
    "x, y, z are drawn in this order, a statement each: the order in which a function's "
    "arguments are evaluated is the compiler's choice."};
const Diagnosis dart_reused{"reused-number",
                            "fewer than three numbers are drawn per dart: coordinates share one."};

constexpr std::size_t n = 200'000;

Rows drawn(Vec3 normal) {
  return probe("Lab 7.2 directions",
               {.n = n, .numbers = {{"x", normal.x}, {"y", normal.y}, {"z", normal.z}}},
               {.rows = n,
                .columns = 4,
                .of = fmt::format("normal ({:g}, {:g}, {:g})", normal.x, normal.y, normal.z)});
}

bool in_one_octant(const std::vector<Double3>& directions) {
  return std::all_of(directions.begin(), directions.end(), [](Double3 w) {
    return (w.x >= 0 && w.y >= 0 && w.z >= 0) || (w.x <= 0 && w.y <= 0 && w.z <= 0);
  });
}

std::size_t count_below(const std::vector<Double3>& local) {
  return static_cast<std::size_t>(
      std::count_if(local.begin(), local.end(), [](Double3 w) { return w.z < -1e-6; }));
}

/// The dart's direction with its coordinates in another order, above the horizon.
Double3 reordered(Double3 dart, const std::array<int, 3>& order) {
  const Double3 w(dart[order[0]], dart[order[1]], dart[order[2]]);
  return w.z < 0 ? -w : w;
}

/// One direction: the number of darts it claims, and what was drawn from the generator for it.
struct Taken {
  double darts = 0, words = 0;
  Double3 w, first;  ///< the answer, and the direction of the first dart in the ball
};

/// The direction of the first dart in the ball, above the horizon.
Double3 first_in_ball(carlo::Rng rng) {
  Vec3 dart(2);
  while (!(glm::dot(dart, dart) <= 1)) {
    for (int k = 0; k < 3; ++k)
      dart[k] = 2 * rng.uniform_float() - 1;
  }
  return glm::normalize(Double3(dart.z < 0 ? -dart : dart));
}

/// Stops at the first that drew more than can be followed.
std::vector<Taken> taken(std::size_t repetitions) {
  const Answer rows = probe("Lab 7.2 record", {.n = static_cast<std::int64_t>(repetitions)},
                            {.rows = repetitions, .columns = 8});
  std::vector<Taken> all;
  carlo::Rng rng(rows.seed);
  for (std::size_t i = 0; i < repetitions; ++i) {
    const NextWords next{rows.at(i, 4), rows.at(i, 5), rows.at(i, 6), rows.at(i, 7)};
    const double words = words_drawn(rng, next, 3000);
    all.push_back(
        {rows.at(i, 0), words, {rows.at(i, 1), rows.at(i, 2), rows.at(i, 3)}, first_in_ball(rng)});
    if (words < 0) break;
    for (auto left = static_cast<std::int64_t>(words); left > 0; --left)
      rng.next_u32();
  }
  return all;
}

/// True if nearly all answers are right except for the order in which x, y, z were drawn.
bool in_another_order(const std::vector<Taken>& all) {
  for (const std::array<int, 3>& order :
       std::array<std::array<int, 3>, 5>{{{0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}}}) {
    const auto same = std::count_if(all.begin(), all.end(), [&](const Taken& one) {
      return glm::length(one.w - reordered(one.first, order)) <= 1e-5;
    });
    if (static_cast<std::size_t>(same) > all.size() * 9 / 10) return true;
  }
  return false;
}

/// For trials with success probability p, until the first success.
Theory geometric(double p) {
  return {1 / p, std::sqrt(1 - p) / p, 6 + p * p / (1 - p)};
}

}  // namespace

TEST_CASE("Lab 7.2: directions have length 1, lie above the horizon and are uniform",
          "[lab07][ex2]") {
  for (const Vec3 normal : {Vec3(0, 0, 1), Vec3(0.48f, -0.6f, -0.64f)}) {
    const std::vector<Double3> world = directions_in(drawn(normal));
    const std::vector<Double3> local = local_to(Axes(normal), world);
    judge(all_unit(world));
    const std::size_t lost = count_below(local);
    judge(holds("directions below the horizon", lost == 0, fmt::format("{} of {}", lost, n), "none",
                {below}));
    Verdict verdict = distributed(
        fmt::format("directions around ({:g}, {:g}, {:g})", normal.x, normal.y, normal.z), local,
        power_law(1));
    if (!verdict.passed && in_one_octant(world)) verdict.diagnoses.push_back(octant);
    judge(verdict);
  }
}

TEST_CASE("Lab 7.2: the mean cosine is 1/2", "[lab07][ex2]") {
  const Rows rows = drawn({0, 0, 1});
  judge(mean_is("the mean of cos(theta)", column(rows, 2), {0.5, std::sqrt(1.0 / 12), -1.2},
                {{0.5155, corners}}));
}

TEST_CASE("Lab 7.2: a direction takes 6/pi darts on average", "[lab07][ex2]") {
  const std::vector<double> darts = column(drawn({0, 0.6f, 0.8f}), 3);
  const double p = pi / 6;
  judge(mean_is(
      "the mean number of darts", darts, geometric(p),
      {{1, corners}, {1 / p - 1, accepted_not_counted}, {2 / p, thrown_away}, {4 / pi, disc}}));
  judge(variance_is("the variance of the number of darts", darts, geometric(p)));
}

TEST_CASE("Lab 7.2: a dart is three fresh numbers, x, y and z, and the first in the ball is taken",
          "[lab07][ex2]") {
  constexpr std::size_t repetitions = 500;
  const std::vector<Taken> all = taken(repetitions);
  std::size_t wrong_words = 0, wrong_direction = 0;
  double fewer = 0;
  for (const Taken& one : all) {
    if (one.words != 3 * one.darts) ++wrong_words;
    if (one.words < 3 * one.darts) fewer += 1;
    if (!(glm::length(one.w - one.first) <= 1e-5)) ++wrong_direction;
  }
  std::vector<Diagnosis> diagnoses;
  if (2 * fewer > static_cast<double>(all.size())) diagnoses.push_back(dart_reused);
  judge(holds("numbers drawn", wrong_words == 0,
              fmt::format("not three for every dart told, {} times of {}", wrong_words, all.size()),
              "three uniform_float() a dart", diagnoses));
  judge(holds(
      "the direction", wrong_direction == 0,
      fmt::format("not that of the first dart in the ball, {} times of {}", wrong_direction,
                  all.size()),
      "that of the first dart in the ball",
      in_another_order(all) ? std::vector<Diagnosis>{order_of_numbers} : std::vector<Diagnosis>{}));
}
