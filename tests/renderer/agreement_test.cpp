// Three integrators that share no line of light transport agree, on every tile of every scene: lab
// 8's solution by recursion as in the lecture, corrected (trace_path(), or trace_specular()), lab
// 8's solution in a loop (path_radiance()), and the reference renderer.
//
// The lecture's estimator must have finite variance: with lights that have an area and surfaces
// that absorb, trace_path()'s has. A bounce weighs at most (n + 2)/(n + 1) and is survived with
// probability kd + ks; ((n + 2)/(n + 1))^2 (kd + ks) < 1 in all our scenes, and the radiances that
// paths meet are bounded. Lab 8 refuses point lights, which no direction meets, and no scene has
// them; it also refuses the environment map of `image_light`, which is left out here.
// trace_specular() replaces trace_path() in three scenes: in `caustics` and `procedural`, since
// trace_path() does not support mirrors and glass; and in `highlights`, where the variance is
// finite, but only one path in about 10^5 meets the smallest light, so that no tile would be close
// to normal. It samples lights by area, whose 1/d^2 has infinite variance where a surface touches a
// light; in these scenes none does. In `rare_paths` a few bright paths make up the noise, and it
// takes many of them for a normal sum: the loop needs 3 million in a tile at seed 2; with a quarter
// of them a tile's skewness, .6, leads to two expected false alarms. So all three get more samples
// there, in larger tiles; nightly runs use smaller ones, with four times the samples.
//
// Error rates: a tile's channel is outside 4 standard errors with probability 6.3e-5 if it is
// normal, the whole image outside 3 with 2.7e-3. There are 48 + 3 comparisons for each pair and
// scene: over 14 scenes another seed would fail somewhere with probability at most .12 for the
// tiles (.24 with their skewness) and .25 for the images; channels and pairs are correlated. So the
// seed is fixed. The skewness shows whether tiles are normal enough: the number of false alarms
// that it leads to is computed and limited. Power: a tile's difference has a standard error of .4
// to 3.5 % of the image (rare_paths 7 %, highlights, where lights are seen, 15 %), the whole
// image's of .1 to .9 % (3 and 4 %); deviations of 7 and 6 standard errors are detected with
// probability .999.
//
// CARLO_AGREEMENT_SEED, CARLO_AGREEMENT_SIZE (pixels per side, a multiple of the tile's),
// CARLO_AGREEMENT_TILE and CARLO_AGREEMENT_FACTOR (times the samples) test other samples, more or
// smaller tiles, and smaller deviations; CARLO_AGREEMENT_SCENE selects one scene.

#include "lab_scenes.h"
#include "scene/needs.h"
#include "scene_renderer/lab_integrator.h"
#include "scene_tools.h"
#include "tiles.h"

#include <catch2/catch_test_macros.hpp>
#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <string>
#include <vector>

namespace {

using namespace scene_tools;
using tiles::Channel, tiles::Tile;
using tiles::Estimate;
using tiles::Samples;

constexpr double tile_limit = 4, image_limit = 3;
constexpr double most_false_alarms = .1;  ///< expected, in the tiles of one comparison

std::uint32_t from_environment(const char* name, std::uint32_t otherwise) {
  const char* text = std::getenv(name);
  return text == nullptr ? otherwise : static_cast<std::uint32_t>(std::strtoul(text, nullptr, 10));
}

/// The selected scenes.
std::vector<std::string> scene_names() {
  const char* only = std::getenv("CARLO_AGREEMENT_SCENE");
  return only == nullptr ? lab_scenes::names() : std::vector<std::string>{only};
}

/// The recursive tracer for a scene, and the samples per pixel of each integrator in multiples of
/// 128: enough for normal tiles.
struct Plan {
  lab08::Method method = lab08::Method::recursive;
  std::uint32_t recursive = 8, iterative = 4, reference = 4;
  int tile = 8;  ///< pixels per side
};

Plan plan_of(const std::string& scene) {
  using lab08::Method;
  if (scene == "rare_paths") return {Method::recursive, 24, 96, 192, 16};
  if (scene == "highlights") return {Method::direct, 96, 16, 16};
  if (scene == "furnace" || scene == "integrating_sphere") return {Method::recursive, 4, 2, 2};
  if (scene == "caustics") return {Method::direct, 16, 8, 8};
  if (scene == "procedural") return {Method::direct, 4, 2, 2};
  if (scene == "cornell_lambert") return {Method::recursive, 16, 8, 8};
  if (scene == "cornell_phong") return {Method::recursive, 16, 16, 16};
  if (scene == "many_lights") return {Method::recursive, 24, 8, 8};
  return {};
}

/// The three estimates of one scene, from independent numbers.
struct Estimates {
  Estimate recursive, iterative, reference;
};

Estimates estimate(Scene scene, const Plan& plan) {
  const auto size = static_cast<int>(from_environment("CARLO_AGREEMENT_SIZE", 32));
  const std::uint32_t factor = 4 * from_environment("CARLO_AGREEMENT_FACTOR", 1);
  const std::uint64_t seed = 3 * from_environment("CARLO_AGREEMENT_SEED", 2);
  const auto samples = [factor](std::uint32_t times) { return Samples{32, factor * times}; };
  const Samples first = samples(plan.recursive), second = samples(plan.iterative),
                third = samples(plan.reference);
  const int tile = static_cast<int>(
      from_environment("CARLO_AGREEMENT_TILE", static_cast<std::uint32_t>(plan.tile)));
  resize(scene, size, size);
  scene.sampler = SamplerKind::independent;
  // The recursive tracers have no limit. The scene that has one shows only lights.
  scene.max_depth = 0;
  const auto recursive = lab08::make_lab_integrator(scene, {plan.method, seed, first.per_pixel()});
  const auto iterative =
      lab08::make_lab_integrator(scene, {lab08::Method::iterative, seed + 1, second.per_pixel()});
  const auto reference =
      renderer::make_path_integrator(scene, {.seed = seed + 2, .spp = third.per_pixel()});
  return {tiles::estimate(*recursive, size, tile, first),
          tiles::estimate(*iterative, size, tile, second),
          tiles::estimate(*reference, size, tile, third)};
}

/// max(|z|, worst) that keeps NaN.
void raise(double& worst, double z) {
  if (!(std::abs(z) <= worst)) worst = std::abs(z);
}

/// The comparison of the tiles of two estimates.
struct Comparison {
  double worst = 0, whole = 0;  ///< largest |z| of a tile and of the whole image
  double skewness = 0;          ///< the largest of any tile
  double false_alarms = 0;      ///< expected number beyond tile_limit
  /// Standard errors of the difference, relative to the image's mean: rms of a tile, and of all.
  double tile_error = 0, image_error = 0;
};

double mean_of(const Tile& channels, double Channel::*member) {
  return (channels[0].*member + channels[1].*member + channels[2].*member) / 3;
}

Comparison compare_estimates(const Estimate& a, const Estimate& b) {
  Comparison result;
  for (std::size_t c = 0; c < 3; ++c) {
    raise(result.whole, tiles::z(a.whole[c], b.whole[c]));
    for (std::size_t i = 0; i < a.tiles.size(); ++i) {
      raise(result.worst, tiles::z(a.tiles[i][c], b.tiles[i][c]));
      const double skewness = tiles::skewness(a.tiles[i][c], b.tiles[i][c]);
      raise(result.skewness, skewness);
      result.false_alarms += tiles::tail(tile_limit, skewness);
    }
  }
  const double count = static_cast<double>(a.tiles.size()), mean = mean_of(b.whole, &Channel::mean);
  const double variance =
      mean_of(a.whole, &Channel::variance) + mean_of(b.whole, &Channel::variance);
  result.image_error = std::sqrt(variance) / mean;
  result.tile_error = std::sqrt(variance * count) / mean;
  return result;
}

void check_agreement(const std::string& scene, const char* names, const Estimate& a,
                     const Estimate& b) {
  const Comparison found = compare_estimates(a, b);
  fmt::print("{:<20} {:<24} {:>8.2f} {:>8.2f} {:>8.2f} {:>8.2f} {:>10.3f} {:>14.4f}\n", scene,
             names, 100 * found.tile_error, 100 * found.image_error, found.worst, found.whole,
             found.skewness, found.false_alarms);
  INFO(scene << ", " << names);
  CHECK(found.worst <= tile_limit);
  CHECK(found.whole <= image_limit);
  // If there are more, the tiles are not normal, and the scene needs more samples.
  CHECK(found.false_alarms <= most_false_alarms);
}

}  // namespace

TEST_CASE("Recursive, iterative and reference integrator agree on every tile of every scene") {
  fmt::print("{:<20} {:<24} {:>8} {:>8} {:>8} {:>8} {:>10} {:>14}\n", "scene", "compared", "tile %",
             "image %", "tile |z|", "image |z|", "skewness", "false alarms");
  REQUIRE(lab_scenes::names().size() >= 13);
  for (const std::string& name : scene_names()) {
    const Scene scene = lab_scenes::load(name);
    if (needs(scene).envmap) continue;  // lab 8 does not support an image as a light
    const Estimates e = estimate(scene, plan_of(name));
    check_agreement(name, "recursive, iterative", e.recursive, e.iterative);
    check_agreement(name, "recursive, reference", e.recursive, e.reference);
    check_agreement(name, "iterative, reference", e.iterative, e.reference);
    for (const Estimate* estimate : {&e.recursive, &e.iterative, &e.reference}) {
      CHECK(estimate->counts.bad == 0);
      CHECK(estimate->whole[0].mean > 0);
    }
  }
}
