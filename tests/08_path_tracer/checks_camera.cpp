// Checks of exercise 8.1: each stratum of a pixel has a ray, and the positions within the strata
// are uniform.

#include "08_path_tracer/theory.h"
#include "grader/judge/figures.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>
#include <vector>

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
const Diagnosis not_averaged{"sum-not-averaged",
                             "the mean is the sum over the number of rays, strata x strata."};
const Diagnosis misses_pixel{"rays-miss-the-pixel",
                             "rays go through other pixels: x and y are added to the position "
                             "within the pixel, then divided by width and height."};
const Diagnosis upside_down{"pixels-upside-down",
                            "y counts from the top, and so does the film's second coordinate."};

/// One ray is right; each one more or less is drawn as four standard deviations.
Figure strata_picture(std::size_t strata, const std::vector<double>& rays) {
  const std::vector<double> one(rays.size(), 1.0), sd(rays.size(), 0.25);
  Figure figure = tiles_figure(strata, rays, one, sd);
  figure.title = "Rays in each stratum of the pixel";
  figure.note = "Blank: one ray, as it should be.";
  return figure;
}

/// The directions are floats: for a position closer than this to a stratum's edge rounding decides
/// the side. A strict test fails a right solution for one seed of 2000.
constexpr double rounding = 1e-4;

/// The number of strata with a ray of their own, where one on an edge may count for either side.
std::size_t strata_met(int strata, const std::vector<std::pair<double, double>>& places) {
  const auto sides = [strata](double x) {
    std::set<int> all;
    for (const double shift : {-rounding, rounding}) {
      const int side = static_cast<int>(std::floor(x + shift));
      if (side >= 0 && side < strata) all.insert(side);
    }
    return all;
  };
  std::set<std::pair<int, int>> met;
  std::vector<std::vector<std::pair<int, int>>> on_edges;
  for (const auto& [u, v] : places) {
    std::vector<std::pair<int, int>> candidates;
    for (const int column : sides(u)) {
      for (const int row : sides(v))
        candidates.emplace_back(column, row);
    }
    if (candidates.size() == 1) met.insert(candidates[0]);
    if (candidates.size() > 1) on_edges.push_back(candidates);
  }
  for (const auto& candidates : on_edges) {
    const auto free = std::find_if(candidates.begin(), candidates.end(),
                                   [&](const auto& c) { return met.count(c) == 0; });
    if (free != candidates.end()) met.insert(*free);
  }
  return met.size();
}

std::string pixel(int x, int y, int strata) {
  return fmt::format("pixel ({}, {}), {} x {} strata", x, y, strata, strata);
}

}  // namespace

TEST_CASE("Lab 8.1: one ray in every stratum of the pixel, uniform within it", "[lab08][ex1]") {
  std::vector<double> across, down;
  for (const int strata : {1, 3, 16}) {
    const auto k = static_cast<std::size_t>(strata);
    const Rows rows = probe("Lab 8.1 rays", {.n = strata, .numbers = {{"x", 5}, {"y", 6}}},
                            {.rows = k * k + 2, .columns = 2, .of = pixel(5, 6, strata)});
    std::vector<std::pair<double, double>> places;
    double same_across = 0, same_down = 0, same = 0;
    bool mirrored = true, astray = false;
    std::vector<double> rays(k * k);
    for (std::size_t i = 0; i < k * k; ++i) {
      const double u = rows.at(i, 0) * strata, v = rows.at(i, 1) * strata;
      places.emplace_back(u, v);
      if (u >= -rounding && u < strata + rounding && v >= -rounding && v < strata + rounding) {
        const int column = std::clamp(static_cast<int>(u), 0, strata - 1);
        const int row = std::clamp(static_cast<int>(v), 0, strata - 1);
        rays[static_cast<std::size_t>(row * strata + column)] += 1;
      } else {
        astray = true;
      }
      mirrored = mirrored && rows.at(i, 1) + 6 >= 1 - rounding && rows.at(i, 1) + 6 <= 2 + rounding;
      across.push_back(u - std::floor(u));
      down.push_back(v - std::floor(v));
      same_across += std::abs(across.back() - across[across.size() - i - 1]) < 1e-3 ? 1 : 0;
      same_down += std::abs(down.back() - down[down.size() - i - 1]) < 1e-3 ? 1 : 0;
      same += std::abs(across.back() - down.back()) < 1e-3 ? 1 : 0;
    }
    const auto all = static_cast<double>(k * k);
    const std::size_t met = strata_met(strata, places);
    std::vector<Diagnosis> diagnoses;
    diagnoses.push_back(mirrored ? upside_down : astray ? misses_pixel : not_stratified);
    Verdict verdict =
        holds(fmt::format("strata of a pixel cut {} x {} that have a ray", strata, strata),
              met == k * k, fmt::format("{} of {}", met, k * k), "all", diagnoses);
    if (!verdict.passed && strata > 1) verdict.figure = strata_picture(k, rays);
    judge(verdict);
    if (strata == 16) {
      const double corner = std::max(same_across, same_down);
      judge(holds("places in the strata", corner < all / 2 && same < all / 2,
                  corner >= all / 2 ? "all the same, across or down"
                  : same >= all / 2 ? "on a diagonal"
                                    : "spread",
                  "spread over them", {corner >= all / 2 ? not_jittered : diagonal}));
    }
  }
  judge(uniform_on("places across the strata", across, 0, 1));
  judge(uniform_on("places down the strata", down, 0, 1));
}

TEST_CASE("Lab 8.1: the mean of what the rays bring, each asked once", "[lab08][ex1]") {
  const Rows rows = probe("Lab 8.1 rays", {.n = 4, .numbers = {{"x", 0}, {"y", 7}}},
                          {.rows = 18, .columns = 2, .of = pixel(0, 7, 4)});
  judge(equals("rays", rows.at(17, 1), 16, 0));
  judge(equals("the mean of 1, 2, ... 16", rows.at(16, 0), 8.5, 1e-5,
               {{136, not_averaged}, {34, not_averaged}}));
  judge(equals("the mean of 1^2, 2^2, ... 16^2", rows.at(17, 0), 93.5, 1e-4,
               {{1496, not_averaged}, {374, not_averaged}}));
}
