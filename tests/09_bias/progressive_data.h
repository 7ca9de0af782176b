#pragma once

#include "numeric/vec.h"
#include "random/rng.h"

#include <cstdint>
#include <vector>

// What Lab 9.6's probes ask and its checks work out once more from the probe's seed.

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

/// A chain of radii, and what the passes of a mean bring. Of red all bring the same; of green each
/// has its own; blue is 1 but for the first one, which is so large that a float that holds it does
/// not grow by 1.
struct ProgressiveRun {
  double first_radius, alpha;
};

inline ProgressiveRun drawn_run(std::uint64_t seed) {
  carlo::Rng rng(seed, 1);
  const double radius = 0.5 + rng.uniform();
  return {radius, 0.6 + 0.2 * rng.uniform()};
}

inline carlo::Rgb brought_by(int pass, carlo::Rng& rng) {
  return {0.1f, rng.uniform_float(), pass == 1 ? 3e7f : 1.0f};
}

}  // namespace lab09_progressive
