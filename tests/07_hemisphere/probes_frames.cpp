// Finds where the student's frames are weakest. An axis that a method cannot handle is a point of
// the sphere that no list of normals contains. But s turns ever faster as the normal approaches it,
// which leads there.

#include "07_hemisphere/places.h"
#include "grader/worker/probe.h"
#include "hemisphere.h"
#include "random/rng.h"

#include <algorithm>

using namespace lab07_tests;
using carlo::grader::RowWriter;

namespace {

struct Found {
  Vec3 normal{0};
  double error = 0;  ///< of lengths and right angles; infinite for axes with NaN
  Double3 s{0};
};

Found try_normal(Double3 direction) {
  const Vec3 normal(glm::normalize(direction));
  const lab07::Frame f(normal);
  const Double3 s(f.s), t(f.t), n(normal);
  const double error =
      std::max({std::abs(glm::length(s) - 1), std::abs(glm::length(t) - 1),
                std::abs(glm::dot(s, t)), std::abs(glm::dot(s, n)), std::abs(glm::dot(t, n))});
  const bool finite = std::isfinite(glm::length(s) + glm::length(t));
  return {normal, finite ? error : HUGE_VAL, finite ? s : Double3(0)};
}

double signed_uniform(carlo::Rng& rng) {
  return 2 * rng.uniform() - 1;
}

Double3 beside(Double3 centre, double radius, carlo::Rng& rng) {
  const double x = signed_uniform(rng);
  const double y = signed_uniform(rng);
  const double z = signed_uniform(rng);
  return glm::normalize(centre + radius * Double3(x, y, z));
}

/// A part of the sphere: its worst normal, and how much s turns in it: 0 not at all, 1 in all
/// directions.
struct Region {
  Double3 centre;
  Found worst;
  double spread = 0;
};

Region look_around(Double3 centre, double radius, carlo::Rng& rng) {
  constexpr int samples = 16;
  Region region{centre, {}};
  Double3 mean(0);
  for (int i = 0; i < samples; ++i) {
    const Found found = try_normal(beside(centre, radius, rng));
    if (found.error > region.worst.error) region.worst = found;
    mean += found.s / static_cast<double>(samples);
  }
  region.spread = 1 - glm::length(mean);
  return region;
}

constexpr double first_radius = 0.06;
constexpr int radii = 30;  ///< each 0.6 of the one before: the last is 2e-8

/// Goes to where s turns most, in ever smaller regions, down to the spacing of floats; returns the
/// worst on the way.
Found climb(Region region, carlo::Rng& rng) {
  constexpr int neighbours = 24;
  Found worst = region.worst;
  double radius = first_radius;
  for (int step = 0; step < radii; ++step) {
    Region best = look_around(region.centre, 0.6 * radius, rng);
    for (int i = 0; i < neighbours; ++i) {
      const Region next = look_around(beside(region.centre, radius, rng), 0.6 * radius, rng);
      if (next.worst.error > worst.error) worst = next.worst;
      if (next.spread > best.spread) best = next;
    }
    region = best;
    radius *= 0.6;
  }
  return worst;
}

}  // namespace

// The worst normal found. Examines n regions all over the sphere; the search climbs from those
// where s turns most.
PROBE("Lab 7.1 search", "normal.x", "normal.y", "normal.z", "s.x", "s.y", "s.z", "t.x", "t.y",
      "t.z") {
  constexpr std::size_t climbs = 10;
  carlo::Rng rng(params.seed);
  std::vector<Region> regions;
  for (std::int64_t i = 0; i < params.n; ++i) {
    const auto k = static_cast<double>(i);
    const double z = 1 - (2 * k + 1) / static_cast<double>(params.n);
    const double phi = 2.399963229728653 * k, sine = std::sqrt(1 - z * z);
    regions.push_back(
        look_around({sine * std::cos(phi), sine * std::sin(phi), z}, first_radius, rng));
  }
  std::sort(regions.begin(), regions.end(),
            [](const Region& a, const Region& b) { return a.spread > b.spread; });
  Found worst;
  for (std::size_t i = 0; i < regions.size(); ++i) {
    const Found found = i < climbs ? climb(regions[i], rng) : regions[i].worst;
    if (found.error > worst.error) worst = found;
  }
  const lab07::Frame f(worst.normal);
  RowWriter rows;
  rows.add(
      {worst.normal.x, worst.normal.y, worst.normal.z, f.s.x, f.s.y, f.s.z, f.t.x, f.t.y, f.t.z});
  return rows.take();
}
