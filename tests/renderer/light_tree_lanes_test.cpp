// The choice among many lights in lanes, on all instruction sets of this machine: lights are chosen
// as often as their probabilities say, and none that can contribute is left out.
//
// Error rates. Frequencies are tested by chi-square at alpha = 1e-4 with 1.3e5 numbers, 20 sets of
// lights and places in all; seeds are fixed, another would fail somewhere with probability 2e-3.
// Power: a probability of .05 that is off by a tenth is detected with probability above .999.

#include "lane_records.h"
#include "random/hash.h"
#include "random/rng.h"
#include "renderer/lanes/lane_light_tree.h"
#include "stats/goodness.h"

#include <catch2/catch_test_macros.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <vector>

// This file is compiled once for each instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "light_tree_lanes_test.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

// These follow the two headers above, which compile them anew.
#include "renderer/lanes/light_tree-inl.h"

HWY_BEFORE_NAMESPACE();
namespace renderer {
namespace HWY_NAMESPACE {

/// Their number is a multiple of every number of lanes.
HWY_ATTR void choose_lights(const LaneLightTree& tree, LightChoices& c) {
  const M all = hn::FirstN(d_, lanes);
  for (std::size_t i = 0; i < c.u.size(); i += lanes) {
    const V3 p{hn::LoadU(d_, &c.px[i]), hn::LoadU(d_, &c.py[i]), hn::LoadU(d_, &c.pz[i])};
    const V3 n{hn::LoadU(d_, &c.nx[i]), hn::LoadU(d_, &c.ny[i]), hn::LoadU(d_, &c.nz[i])};
    V u = hn::LoadU(d_, &c.u[i]);
    const Picked picked = pick_in_tree(tree, p, n, hn::LoadU(du_, &c.word[i]), all, u);
    hn::StoreU(u, d_, &c.u[i]);
    hn::StoreU(picked.index, du_, &c.light[i]);
    hn::StoreU(picked.probability, d_, &c.probability[i]);
    hn::StoreU(probabilities_in_tree(tree, picked.index, p, n, all), d_, &c.again[i]);
  }
}

/// The probabilities of c.light.
HWY_ATTR void probabilities_of(const LaneLightTree& tree, LightChoices& c) {
  const M all = hn::FirstN(d_, lanes);
  for (std::size_t i = 0; i < c.light.size(); i += lanes) {
    const V3 p{hn::LoadU(d_, &c.px[i]), hn::LoadU(d_, &c.py[i]), hn::LoadU(d_, &c.pz[i])};
    const V3 n{hn::LoadU(d_, &c.nx[i]), hn::LoadU(d_, &c.ny[i]), hn::LoadU(d_, &c.nz[i])};
    hn::StoreU(probabilities_in_tree(tree, hn::LoadU(du_, &c.light[i]), p, n, all), d_,
               &c.again[i]);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace renderer
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace renderer {
HWY_EXPORT(choose_lights);
HWY_EXPORT(probabilities_of);

namespace {

using carlo::Rng;
using Vec3d = glm::dvec3;

constexpr double alpha = 1e-4;
constexpr std::size_t most_lanes = 16;

Vec3d in_cube(Rng& rng) {
  const double x = rng.uniform(), y = rng.uniform();
  return 2.0 * Vec3d(x, y, rng.uniform()) - 1.0;
}

/// Points and flat lights, half of which face the same way, with strengths over six orders of
/// magnitude.
std::vector<LaneLight> some_lights(std::size_t count, double scale, bool sky) {
  Rng rng(count, 5);
  std::vector<LaneLight> lights;
  for (std::size_t i = 0; i < count; ++i) {
    LaneLight light;
    light.middle = scale * in_cube(rng);
    light.strength = scale * scale * std::pow(10.0, 6 * rng.uniform() - 3);
    if (i % 3 != 0) {
      const Vec3d n = i % 3 == 1 ? Vec3d(0, -1, 0) : glm::normalize(in_cube(rng));
      light.reach = scale * 0.1 * rng.uniform();
      light.plane = LaneLight::Plane{n, glm::dot(n, light.middle)};
    }
    lights.push_back(light);
  }
  if (sky) lights.push_back({.strength = 1, .everywhere = true});
  return lights;
}

/// The same point for a number of choices.
LightChoices at(Vec3d p, Vec3d n, std::size_t count) {
  const auto same = [&](double x) { return std::vector<float>(count, static_cast<float>(x)); };
  LightChoices c{same(p.x), same(p.y), same(p.z), same(n.x), same(n.y), same(n.z),
                 same(0),   {},        {},        same(0),   same(0)};
  c.word.resize(count), c.light.resize(count);
  for (std::size_t i = 0; i < count; ++i)
    c.word[i] = static_cast<std::uint32_t>(carlo::hash(9, i));
  return c;
}

/// The probabilities of all lights.
std::vector<double> probabilities_at(const LaneLightTree& tree, Vec3d p, Vec3d n) {
  const std::size_t count = tree.leaf_of.size();
  LightChoices c = at(p, n, (count + most_lanes - 1) / most_lanes * most_lanes);
  for (std::size_t i = 0; i < count; ++i)
    c.light[i] = static_cast<std::uint32_t>(i);
  HWY_DYNAMIC_DISPATCH(probabilities_of)(tree, c);
  return {c.again.begin(), c.again.begin() + static_cast<std::ptrdiff_t>(count)};
}

}  // namespace

TEST_CASE("Many lights are chosen in lanes as often as their probabilities say") {
  constexpr std::size_t draws = 1 << 17, step = (1 << 24) / draws;
  for (const auto& [count, scale, sky] :
       {std::tuple{129UL, 1.0, false}, std::tuple{200UL, 1e-4, true}, std::tuple{300UL, 1e5, false},
        std::tuple{300UL, 1.0, true}, std::tuple{5000UL, 1.0, false}}) {
    const LaneLightTree tree(some_lights(count, scale, sky));
    Rng rng(count, 11);
    for (int place = 0; place < 4; ++place) {
      const Vec3d p = scale * in_cube(rng), n = glm::normalize(in_cube(rng));
      INFO(count << " lights, scale " << scale << ", place " << place);
      std::vector<std::uint32_t> first;
      instruction_sets::on_all([&] {
        std::vector<double> expected = probabilities_at(tree, p, n);
        const double sum = std::accumulate(expected.begin(), expected.end(), 0.0);
        CHECK(sum < 1 + 1e-5);
        const double least = *std::min_element(expected.begin(), expected.end());
        CHECK(least >= 0.999999 * LightTree::floor / static_cast<double>(tree.leaf_of.size()));
        LightChoices c = at(p, n, draws);
        for (std::size_t i = 0; i < draws; ++i)
          c.u[i] = static_cast<float>(i * step + c.word[i] % step) * 0x1p-24f;
        HWY_DYNAMIC_DISPATCH(choose_lights)(tree, c);
        std::vector<double> counts(expected.size() + 1);
        double u = 0;
        std::size_t wrong = 0;
        for (std::size_t i = 0; i < draws; ++i) {
          const bool some = c.probability[i] > 0;
          ++counts.at(some ? c.light[i] : expected.size());
          u += some ? static_cast<double>(c.u[i]) : 0.5;
          wrong += c.u[i] < 0 || c.u[i] >= 1 ||
                   (some && std::abs(c.probability[i] / c.again[i] - 1) > 1e-6f);
        }
        CHECK(wrong == 0);
        // The rest up to 1: all lights of a node that was chosen are out of sight.
        expected.push_back(std::max(1 - sum, 0.0));
        for (double& probability : expected)
          probability *= draws;
        CHECK(carlo::pooled_goodness(counts, expected).p > alpha);
        // Standard error: .0007; u is stratified, which makes it less.
        CHECK(std::abs(u / draws - 0.5) < 0.004);
        if (first.empty()) first = c.light;
        CHECK(c.light == first);
      });
    }
  }
}

TEST_CASE("Where none of many lights can contribute, lanes choose one evenly or none") {
  std::vector<LaneLight> lights;
  for (int i = 0; i < 200; ++i) {
    LaneLight light;
    light.middle = {i, 0, 0};
    light.strength = 1;
    light.plane = LaneLight::Plane{{0, 1, 0}, 0};
    lights.push_back(light);
  }
  const LaneLightTree tree(lights);
  instruction_sets::on_all([&] {
    LightChoices c = at({0, -1, 0}, {0, 1, 0}, 1600);
    for (std::size_t i = 0; i < c.u.size(); ++i)
      c.u[i] = static_cast<float>(i) / static_cast<float>(c.u.size());
    const std::vector<float> u = c.u;
    HWY_DYNAMIC_DISPATCH(choose_lights)(tree, c);
    for (std::size_t i = 0; i < u.size(); ++i)
      CHECK(c.probability[i] == (u[i] < 1.0f / 16 ? 1.0f / 16 / 200 : 0.0f));
  });
}

}  // namespace renderer
#endif
