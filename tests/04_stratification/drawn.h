#pragma once

// Questions that follow from a probe's seed, so that the judge knows them: probes ask them, and
// checks compute the same again.

#include "random/rng.h"

#include <cstdint>
#include <vector>

namespace lab04_tests {

/// A stratum, and a fraction u of the way through it.
struct Share {
  std::int32_t stratum;
  float u;
};

/// For n strata: 16 at both ends of the range and of the strata, and `count` - 16 at random.
inline std::vector<Share> drawn_shares(std::uint64_t seed, std::int32_t n, std::int64_t count) {
  constexpr float last = 1 - 0x1p-24f;
  std::vector<Share> shares;
  for (const std::int32_t i : {0, n / 3, n / 2, n - 1}) {
    for (const float u : {0.0f, 0x1p-24f, 0.5f, last})
      shares.push_back({i, u});
  }
  carlo::Rng rng(seed);
  for (std::int64_t k = 16; k < count; ++k) {
    const auto i = static_cast<std::int32_t>(rng.uniform() * static_cast<double>(n));
    // A third each: anywhere in the stratum, at its lower end, at its upper end.
    const float u = rng.uniform_float();
    shares.push_back({i, k % 3 == 0 ? u : k % 3 == 1 ? 0.0f : last});
  }
  return shares;
}

/// offset + s x^2 + t y with s from 1 to 2 and t from 2 to 3.
struct DrawnPlane {
  double offset, s, t;

  double operator()(double x, double y) const { return offset + s * x * x + t * y; }
};

inline DrawnPlane drawn_plane(std::uint64_t seed, double offset) {
  carlo::Rng rng(seed, 1);  // stream 0 is the exercise's
  const double s = 1 + rng.uniform();
  return {offset, s, 2 + rng.uniform()};
}

}  // namespace lab04_tests
