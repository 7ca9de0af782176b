// The choice of a light: sample() agrees with probability(), no light is left out, and estimates
// are close to the lights' actual contributions.
//
// Error rates. Frequencies are tested by chi-square at alpha = 1e-4 with 2e5 numbers for each of 24
// sets of lights; seeds are fixed, another would fail somewhere with probability 2.4e-3. Power: a
// probability of .05 that is off by a tenth is detected with probability above .999. Probabilities
// too small for that are compared with the lengths of the intervals of u, found by bisection to
// 1e-15, without statistics.

#include "renderer/light_tree.h"

#include "closed_forms.h"
#include "random/rng.h"
#include "stats/goodness.h"

#include <catch2/catch_test_macros.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <optional>
#include <vector>

namespace {

using carlo::Rng;
using closed_forms::pi;
using glm::dvec3;
using renderer::LightBounds;
using renderer::LightTree;

constexpr double alpha = 1e-4;

double magnitude(Rng& rng, double low, double high) {
  return std::pow(10.0, low + (high - low) * rng.uniform());
}

dvec3 direction(Rng& rng) {
  const double z = 2 * rng.uniform() - 1, phi = 2 * pi * rng.uniform();
  const double r = std::sqrt(1 - z * z);
  return {r * std::cos(phi), r * std::sin(phi), z};
}

dvec3 in_cube(Rng& rng) {
  const double x = rng.uniform(), y = rng.uniform();
  return 2.0 * dvec3(x, y, rng.uniform()) - 1.0;
}

/// A point, a flat light, or one whose normals fill a cone: in a cube of half side `scale`, with
/// strengths over six orders of magnitude.
LightBounds random_light(Rng& rng, double scale) {
  const dvec3 at = scale * in_cube(rng);
  const dvec3 half = scale * magnitude(rng, -4, -1) * glm::abs(in_cube(rng));
  const double kind = rng.uniform(), strength = scale * scale * magnitude(rng, -3, 3);
  if (kind < .4) return {at, at, {}, -1, strength};
  const double spread = kind < .8 ? 1 : std::cos(pi * rng.uniform());
  return {at - half, at + half, direction(rng), spread, strength};
}

struct SomeLights {
  std::vector<LightBounds> lights;
  std::optional<double> around;
  double scale;

  SomeLights(Rng& rng, std::size_t count, double size) : scale(size) {
    for (std::size_t i = 0; i < count; ++i)
      lights.push_back(random_light(rng, scale));
    if (rng.uniform() < .3) around = magnitude(rng, -3, 3);
  }
  std::size_t count() const { return lights.size() + (around ? 1 : 0); }
};

struct Here {
  dvec3 p, n;
};

/// Anywhere about the lights, or at one of them.
Here random_place(Rng& rng, const SomeLights& some) {
  const double where = rng.uniform();
  dvec3 p = some.scale * magnitude(rng, -1, 2) * in_cube(rng);
  if (where < .2) {
    const auto i =
        static_cast<std::size_t>(rng.uniform() * static_cast<double>(some.lights.size()));
    p = .5 * (some.lights[i].lower + some.lights[i].upper);
  }
  return {p, direction(rng)};
}

/// The probabilities of all lights; the rest up to 1 is where sample() gives nothing.
std::vector<double> probabilities_at(const LightTree& tree, std::size_t count, const Here& here) {
  std::vector<double> probabilities;
  for (std::uint32_t i = 0; i < count; ++i)
    probabilities.push_back(tree.probability(i, here.p, here.n));
  return probabilities;
}

TEST_CASE("Lights are chosen as often as their chances say, and what is left of u is uniform") {
  Rng rng(71);
  constexpr int draws = 200000, cells = 64;
  for (int set = 0; set < 24; ++set) {
    const std::size_t count =
        std::array<std::size_t, 6>{1, 2, 3, 10, 128, 1000}[static_cast<std::size_t>(set % 6)];
    const SomeLights some(rng, count,
                          std::array{1e-4, 1.0, 1e6}[static_cast<std::size_t>(set % 3)]);
    const LightTree tree(some.lights, some.around);
    const Here here = random_place(rng, some);
    std::vector<double> expected = probabilities_at(tree, some.count(), here);
    expected.push_back(1 - std::accumulate(expected.begin(), expected.end(), 0.0));
    std::vector<double> counts(expected.size()), rest(cells);
    double chosen = 0;
    for (int i = 0; i < draws; ++i) {
      const auto choice = tree.sample(here.p, here.n, rng.uniform());
      ++counts[choice ? choice->light : some.count()];
      if (!choice) continue;
      CHECK(std::abs(choice->probability / expected[choice->light] - 1) <= 1e-9);
      REQUIRE((choice->u >= 0 && choice->u < 1));
      ++rest[static_cast<std::size_t>(choice->u * cells)];
      ++chosen;
    }
    for (double& e : expected)
      e = std::max(0.0, e) * draws;
    INFO("set " << set << ", " << count << " lights");
    const bool one_cell = *std::max_element(expected.begin(), expected.end()) > draws - 200;
    if (!one_cell) CHECK(carlo::pooled_goodness(counts, expected).p >= alpha);
    if (one_cell) CHECK(*std::max_element(counts.begin(), counts.end()) > draws - 400);
    const std::vector<double> even(cells, chosen / cells);
    CHECK(carlo::pooled_goodness(rest, even).p >= alpha);
  }
}

/// The intervals of u for a tree at a place, in order: found where the choice changes.
struct Intervals {
  const LightTree& tree;
  const Here& here;
  std::vector<double> length;  ///< for each light; the last: for no light

  std::size_t at(double u) const {
    const auto choice = tree.sample(here.p, here.n, u);
    return choice ? choice->light : length.size() - 1;
  }
  /// Splits [a, b], at whose ends the choices are `left` and `right`; there no light has an
  /// interval shorter than `step` without a neighbour's end in it.
  void walk(double a, std::size_t left, double b, std::size_t right) {
    if (left == right) {
      length[left] += b - a;
      return;
    }
    if (b - a < 1e-15) {
      length[left] += b - a;
      return;
    }
    const double m = .5 * (a + b);
    const std::size_t middle = at(m);
    walk(a, left, m, middle);
    walk(m, middle, b, right);
  }
};

TEST_CASE("Chances of a millionth are lengths of intervals of u") {
  Rng rng(72);
  int small = 0;
  for (int set = 0; set < 80; ++set) {
    const SomeLights some(rng, 2 + static_cast<std::size_t>(set % 5), 1);
    const LightTree tree(some.lights, some.around);
    const Here here = random_place(rng, some);
    Intervals intervals{tree, here, std::vector<double>(some.count() + 1)};
    // A grid finer than all but the shortest intervals: the range between two of its points is
    // bisected where they differ.
    constexpr int grid = 1 << 18;
    std::size_t left = intervals.at(0);
    for (int i = 0; i < grid; ++i) {
      const double a = static_cast<double>(i) / grid;
      const double b = std::min(static_cast<double>(i + 1) / grid, 1 - 0x1p-53);
      const std::size_t right = intervals.at(b);
      intervals.walk(a, left, b, right);
      left = right;
    }
    for (std::uint32_t i = 0; i < some.count(); ++i) {
      const double probability = tree.probability(i, here.p, here.n);
      const double base =
          some.count() == 1 ? 0 : LightTree::floor / static_cast<double>(some.count());
      small += probability > base && probability - base < 1e-4 ? 1 : 0;
      // An interval shorter than the grid's step may be missed: by no more than that.
      const double missed = probability - base < 1.0 / grid ? 1.0 / grid : 1e-9;
      INFO("set " << set << ", light " << i << ": " << intervals.length[i] << " for "
                  << probability);
      CHECK(std::abs(intervals.length[i] - probability) <= missed);
    }
  }
  CHECK(small >= 10);
}

TEST_CASE("Chances sum to 1 or less, by what sample() fails, and none is below its floor") {
  Rng rng(73);
  for (const std::size_t count : {1UL, 2UL, 5UL, 127UL, 128UL, 129UL, 5000UL, 100000UL}) {
    const int places = count > 1000 ? 4 : 40;
    const double scale = magnitude(rng, -4, 6);
    const SomeLights some(rng, count, scale);
    const LightTree tree(some.lights, some.around);
    const double floor = LightTree::floor / static_cast<double>(some.count());
    for (int k = 0; k < places; ++k) {
      const Here here = random_place(rng, some);
      const std::vector<double> probabilities = probabilities_at(tree, some.count(), here);
      const double sum = std::accumulate(probabilities.begin(), probabilities.end(), 0.0);
      CHECK(sum <= 1 + 1e-9);
      CHECK(*std::min_element(probabilities.begin(), probabilities.end()) >= std::min(floor, 1.0));
      // If nothing fails in 1000 draws, at most 1 % does, except with probability 4e-5.
      int failed = 0;
      for (int i = 0; i < 1000; ++i)
        failed += tree.sample(here.p, here.n, rng.uniform()) ? 0 : 1;
      if (failed == 0) CHECK(sum >= .99);
      CHECK(std::abs(failed / 1000. - (1 - sum)) <= 5 * std::sqrt(.25 / 1000));
    }
  }
}

TEST_CASE("Lights in one place, one light, and lights where the point is, are chosen alike") {
  const LightBounds one{{1, 2, 3}, {1, 2, 3}, {}, -1, 5};
  for (const std::size_t count : {1UL, 2UL, 7UL, 4096UL}) {
    const LightTree tree(std::vector<LightBounds>(count, one));
    for (const dvec3 p : {dvec3(0), dvec3(1, 2, 3), dvec3(1e9, 0, 0)}) {
      for (const dvec3 n : {dvec3(0, 0, 1), dvec3(0, 0, -1)}) {
        double sum = 0;
        for (std::uint32_t i = 0; i < count; ++i) {
          const double probability = tree.probability(i, p, n);
          CHECK(probability >= std::min(1.0, LightTree::floor / static_cast<double>(count)));
          sum += probability;
        }
        CHECK(sum <= 1 + 1e-9);
        for (const double u : {0.0, LightTree::floor, .5, 1 - 0x1p-53}) {
          const auto choice = tree.sample(p, n, u);
          if (!choice) continue;
          CHECK(choice->light < count);
          CHECK((choice->u >= 0 && choice->u < 1));
          CHECK(choice->probability > 0);
        }
      }
    }
  }
}

/// A possible part of a light: a point of its box and a normal of its cone.
Here random_part(Rng& rng, const LightBounds& light) {
  const double x = rng.uniform(), y = rng.uniform();
  const dvec3 p = light.lower + dvec3(x, y, rng.uniform()) * (light.upper - light.lower);
  if (light.cos_spread <= -1) return {p, direction(rng)};
  const double angle = std::acos(light.cos_spread) * rng.uniform();
  const dvec3 aside = glm::normalize(glm::cross(light.axis, direction(rng)));
  return {p, std::cos(angle) * light.axis + std::sin(angle) * aside};
}

TEST_CASE("No light is taken to bring nothing of which a part faces the point from above") {
  Rng rng(74);
  int facing = 0;
  for (int i = 0; i < 400000; ++i) {
    const double scale = std::array{1e-4, 1.0, 1e6}[static_cast<std::size_t>(i % 3)];
    const LightBounds light = random_light(rng, scale);
    const Here here{scale * magnitude(rng, -2, 1) * in_cube(rng), direction(rng)};
    const Here part = random_part(rng, light);
    const dvec3 d = part.p - here.p;
    // By more than rounding.
    const double length = glm::length(d);
    if (!(glm::dot(here.n, d) > 1e-9 * length) || !(glm::dot(part.n, -d) > 1e-9 * length)) continue;
    ++facing;
    const double brings = renderer::estimate_irradiance(light, here.p, here.n);
    if (brings > 0 && std::isfinite(brings)) continue;
    INFO("number " << i << ": " << brings);
    CHECK((brings > 0 && std::isfinite(brings)));
  }
  CHECK(facing > 50000);
}

/// True if the middle of a light is above the horizon and sends light there. (The sphere around a
/// light below the horizon may reach above it, while the one around its group need not.)
bool middle_faces(const LightBounds& light, const Here& here) {
  const dvec3 d = .5 * (light.lower + light.upper) - here.p;
  const double least = 1e-5 * glm::length(d);
  return glm::dot(here.n, d) > least &&
         (light.cos_spread <= -1 || -glm::dot(light.axis, d) > least);
}

TEST_CASE("What groups of a tree are taken to bring is 0 only where that of all members is") {
  // A tree that descends by estimates loses a light where a group's estimate is 0: then its
  // probability is no more than the floor.
  Rng rng(75);
  int bright = 0;
  for (int set = 0; set < 60; ++set) {
    const SomeLights some(rng, 40, 1);
    const LightTree tree(some.lights, some.around);
    for (int k = 0; k < 50; ++k) {
      const Here here = random_place(rng, some);
      const double floor = LightTree::floor / static_cast<double>(some.count());
      double all = some.around.value_or(0);
      for (const LightBounds& light : some.lights)
        all += renderer::estimate_irradiance(light, here.p, here.n);
      for (std::uint32_t i = 0; i < some.lights.size(); ++i) {
        const double brings = renderer::estimate_irradiance(some.lights[i], here.p, here.n);
        if (!(brings > 1e-3 * all) || !middle_faces(some.lights[i], here)) continue;
        ++bright;
        CHECK(tree.probability(i, here.p, here.n) > floor);
      }
    }
  }
  CHECK(bright > 5000);
}

TEST_CASE("The estimate is near the irradiance of lights that are small and far") {
  // With an extent of a hundredth of the distance and at most 85 degrees to either normal. The
  // extent adds at most 2 x .01 / cos 85 = .23 of the value. Estimates are floats: for a cosine of
  // .09 rounding is about 1e-6.
  Rng rng(76);
  for (int i = 0; i < 20000; ++i) {
    const double scale = magnitude(rng, -4, 6), radiance = 3, side = .01 * scale;
    const dvec3 d = direction(rng), n = direction(rng), axis = direction(rng);
    const double cos_in = glm::dot(n, d), cos_out = -glm::dot(axis, d);
    if (cos_in < .09 || cos_out < .09) continue;
    const dvec3 x = glm::normalize(glm::cross(axis, direction(rng))), y = glm::cross(axis, x);
    const dvec3 half = .5 * side * (glm::abs(x) + glm::abs(y)), at = scale * d;
    const LightBounds flat{at - half, at + half, axis, 1, radiance * side * side};
    const double exact = radiance * side * side * cos_in * cos_out / (scale * scale);
    const double ratio = renderer::estimate_irradiance(flat, dvec3(0), n) / exact;
    CHECK(ratio >= 1 - 1e-5);
    CHECK(ratio <= 1.6);
    const LightBounds point{at, at, {}, -1, radiance};
    CHECK(std::abs(renderer::estimate_irradiance(point, dvec3(0), n) /
                       (radiance * cos_in / (scale * scale)) -
                   1) <= 1e-5);
  }
}

}  // namespace
