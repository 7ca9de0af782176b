#pragma once

// Questions that follow from the seed, for the probes that ask them and the judge that knows the
// answers: a submission that has memorised the other answers does not know these.

#include "random/rng.h"

#include <cmath>
#include <cstdint>
#include <vector>

namespace lab02_tests {

/// The arguments of pi_interval(). 1 <= thrown <= 1e9; z in [0.5, 4].
struct IntervalQuestion {
  std::int64_t thrown, hits;
  double z;
};

inline std::vector<IntervalQuestion> drawn_intervals(std::uint64_t seed, std::int64_t count) {
  carlo::Rng rng(seed);
  std::vector<IntervalQuestion> questions;
  for (std::int64_t i = 0; i < count; ++i) {
    const double size = 9 * rng.uniform();
    const auto thrown = static_cast<std::int64_t>(std::pow(10, size));
    const double share = rng.uniform();
    const auto hits = static_cast<std::int64_t>(share * static_cast<double>(thrown + 1));
    questions.push_back({thrown, hits, 0.5 + 3.5 * rng.uniform()});
  }
  return questions;
}

/// The arguments of samples_needed().
struct PlanQuestion {
  double deviation, half_width, z;
};

inline std::vector<PlanQuestion> drawn_plans(std::uint64_t seed, std::int64_t count) {
  carlo::Rng rng(seed);
  std::vector<PlanQuestion> questions;
  for (std::int64_t i = 0; i < count; ++i) {
    const double deviation = 0.1 + 3 * rng.uniform();
    const double half_width = 1 / (2 + 500 * rng.uniform());
    questions.push_back({deviation, half_width, 0.5 + 3.5 * rng.uniform()});
  }
  return questions;
}

}  // namespace lab02_tests
