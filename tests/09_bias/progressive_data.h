#pragma once

#include "numeric/vec.h"
#include "random/rng.h"

#include <cstdint>
#include <vector>

// The questions of Lab 9.6's probes, which its checks compute again from the probe's seed.

namespace lab09_progressive {

/// A pass and its radius.
struct ProgressivePass {
  double radius;
  int pass;
  double alpha;
};

inline std::vector<ProgressivePass> drawn_passes(std::uint64_t seed) {
  carlo::Rng rng(seed);
  std::vector<ProgressivePass> passes;
  for (const int pass : {1, 2, 3, 7, 50, 1'000'000}) {
    const double radius = 10 * rng.uniform() + 1.5;
    passes.push_back({radius, pass, 0.2 + 0.25 * rng.uniform()});
  }
  passes.push_back({1e-30, 4, 2 / 3.0});
  passes.push_back({1e30, 4, 2 / 3.0});
  return passes;
}

/// A chain of radii, and the radiances of a mean's passes. Red is the same in all; green is
/// different in each; blue is 1 except in the first, which is so large that a float holding it does
/// not grow by 1.
struct ProgressiveRun {
  double first_radius, alpha;
};

inline ProgressiveRun drawn_run(std::uint64_t seed) {
  carlo::Rng rng(seed, 1);
  const double radius = 0.5 + rng.uniform();
  return {radius, 0.6 + 0.2 * rng.uniform()};
}

inline carlo::Rgb pass_radiance(int pass, carlo::Rng& rng) {
  return {0.1f, rng.uniform_float(), pass == 1 ? 3e7f : 1.0f};
}

}  // namespace lab09_progressive
