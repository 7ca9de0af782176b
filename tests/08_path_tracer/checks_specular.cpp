// Checks of exercise 8.7: worlds of mirrors and glass. Exact values, except in the last one.

#include "08_path_tracer/paths.h"

#include <algorithm>
#include <map>
#include <string>
#include <vector>

using namespace carlo::grader;
using namespace lab08_tests;

namespace {

const Diagnosis emission_lost{"emission-behind-glass-lost",
                              "after a mirror or glass emission counts: no light was sampled "
                              "there."};
const Diagnosis light_black_in_mirror{
    "emission-in-mirror-lost",
    "a light that a mirror's ray hits counts, as if the camera saw it, whether the call for the "
    "mirror itself includes emission or not: no light was sampled there."};

constexpr std::size_t n_paths = 50'000;

Rows trace(std::map<std::string, double> numbers, std::size_t count = 2000) {
  numbers.insert({{"method", 3}, {"emission", 1}, {"degrees", 0}});
  const Params params{.n = static_cast<std::int64_t>(count), .numbers = std::move(numbers)};
  return probe("Lab 8 paths", params, {.rows = count, .columns = 3, .of = view_text(params)});
}

bool is_black(const std::vector<double>& values) {
  return std::all_of(values.begin(), values.end(), [](double x) { return x == 0; });
}

/// With the glass's own emission, of which there is none, or without.
std::vector<double> through_glass(double emission = 1) {
  return column(trace({{"place", behind_glass}, {"emission", emission}}), 0);
}

/// The causes of missing emission: the wall behind a mirror or glass is black apart from its
/// emission, and every path ends there.
std::vector<Diagnosis> of_black(bool in_mirror) {
  if (ends_dark(column(trace({{"place", in_furnace}, {"r", 0.5}, {"g", 0.5}, {"b", 0.5}}), 0))) {
    return {absorbed_dark};
  }
  return {in_mirror && !is_black(through_glass()) ? light_black_in_mirror : emission_lost};
}

}  // namespace

TEST_CASE("Lab 8.7: what is seen in a mirror and through glass", "[lab08][ex7]") {
  const Rows mirror =
      trace({{"place", mirror_ball}, {"r", 0.5}, {"g", 0.6}, {"b", 0.7}, {"degrees", 30}});
  judge(all_equal("a mirror ball under the sky",
                  std::vector(mirror.values.begin(), mirror.values.begin() + 3),
                  std::vector{0.5, 0.6, 0.7}, 1e-5));
  for (const double degrees : {0.0, 70.0}) {
    const std::vector<double> seen =
        column(trace({{"place", glass_ball}, {"degrees", degrees}}), 0);
    judge(all_equal(fmt::format("the sky through a glass ball, {:g} degrees", degrees), seen,
                    std::vector<double>(seen.size(), 1.0), 1e-3));
  }
}

TEST_CASE("Lab 8.7: a light is seen in a mirror, too", "[lab08][ex7]") {
  // Also without the emission of the first surface, which is the mirror and emits nothing.
  for (const double emission : {1.0, 0.0}) {
    const Rows rows = trace(
        {{"place", wall_in_mirror}, {"r", 0.5}, {"g", 0.6}, {"b", 0.7}, {"emission", emission}});
    judge(all_equal(emission == 1 ? "a glowing wall in a mirror"
                                  : "a glowing wall in a mirror, without the mirror's emission",
                    std::vector(rows.values.begin(), rows.values.begin() + 3),
                    std::vector{0.5, 0.6, 0.7}, 1e-5,
                    is_black(rows.values) ? of_black(true) : std::vector<Diagnosis>{}));
  }
}

TEST_CASE("Lab 8.7: emission counts behind mirrors and glass", "[lab08][ex7]") {
  // Behind the ball is a black wall that emits 1: every path ends there, whatever its way.
  const std::vector<double> seen = through_glass();
  judge(all_equal("a glowing wall through a glass ball", seen,
                  std::vector<double>(seen.size(), 1.0), 1e-3,
                  is_black(seen) ? of_black(false) : std::vector<Diagnosis>{}));
  const std::vector<double> unasked = through_glass(0);
  judge(all_equal("a glowing wall through a glass ball, without the glass's emission", unasked,
                  std::vector<double>(unasked.size(), 1.0), 1e-3,
                  is_black(unasked) && !is_black(seen) ? std::vector{emission_lost}
                                                       : std::vector<Diagnosis>{}));
  // The sd is a bound: three halves of a right solution's (no closed form).
  judge(mean_is(
      "radiance in a furnace around a glass ball",
      column(trace({{"place", with_glass}, {"r", 0.5}, {"g", 0.5}, {"b", 0.5}}, n_paths), 0),
      {2, 2}));
}
