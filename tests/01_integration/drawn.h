#pragma once

// Questions that follow from a probe's seed, so that their answers cannot be known beforehand:
// probes ask them, and checks compute the answers again.

#include "random/rng.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace lab01_tests {

/// Numbers from 0 to 10, and the position at which the list is cut in two.
struct DrawnList {
  std::size_t cut = 0;
  std::vector<double> numbers;
};

inline DrawnList drawn_list(std::uint64_t seed, std::int64_t n) {
  carlo::Rng rng(seed);
  DrawnList list;
  list.cut = static_cast<std::size_t>(rng.uniform() * static_cast<double>(n));
  for (std::int64_t i = 0; i < n; ++i) {
    double x = 10 * rng.uniform();
    x *= rng.uniform();
    list.numbers.push_back(x);
  }
  return list;
}

/// A box, and a wave oblique to it: from 1 to 5, not shaped like a polynomial, so that a rule's own
/// error is part of the answer.
struct DrawnWave {
  std::vector<double> lower, upper, slopes;
  double phase = 0;

  double operator()(std::span<const double> x) const {
    double angle = phase;
    for (std::size_t i = 0; i < x.size(); ++i)
      angle += slopes.at(i) * x[i];
    return 3 + 2 * std::sin(angle);
  }
};

inline DrawnWave drawn_wave(std::uint64_t seed, std::size_t dimensions) {
  carlo::Rng rng(seed);
  DrawnWave wave;
  for (std::size_t i = 0; i < dimensions; ++i) {
    wave.lower.push_back(-2 + 4 * rng.uniform());
    wave.upper.push_back(wave.lower[i] + 0.5 + rng.uniform());
    wave.slopes.push_back(1 + 2 * rng.uniform());
  }
  wave.phase = rng.uniform();
  return wave;
}

}  // namespace lab01_tests
