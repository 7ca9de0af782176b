#pragma once

#include "random/rng.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

// The questions of Lab 9.1's probes, which its checks compute again. They follow from the probe's
// seed, so that the answers cannot be known beforehand.

namespace lab09_tests {

/// Estimates of one value.
struct Estimates {
  double exact = 0;
  std::vector<double> values;
};

/// The estimates of a list: around exact + off, evenly spread over `width`.
struct EstimatesCase {
  double exact, off, width;
};

inline std::vector<EstimatesCase> estimates_cases() {
  return {{3, 0.25, 4},         // the bias is lost in the noise
          {3, 2, 1},            // the bias is not lost
          {1e6, 0.001, 0.003},  // far from 0, and nearly all the same
          {-1, 1e8, 3}};        // far from the exact value
}

inline Estimates drawn_estimates(const EstimatesCase& c, std::uint64_t seed, std::int64_t n) {
  carlo::Rng rng(seed);
  Estimates drawn{c.exact, {}};
  for (std::int64_t i = 0; i < n; ++i)
    drawn.values.push_back(c.exact + c.off + c.width * (rng.uniform() - 0.5));
  return drawn;
}

/// Errors that fall roughly as a power of n, in no particular order.
struct ErrorCurve {
  std::vector<double> n, error;
};

inline ErrorCurve drawn_curve(std::uint64_t seed, std::int64_t points) {
  carlo::Rng rng(seed);
  const double slope = -0.2 - rng.uniform();
  const double first = std::exp(10 * rng.uniform() - 5);
  ErrorCurve curve;
  for (std::int64_t i = 0; i < points; ++i) {
    const double n = std::exp2(2 + 4 * static_cast<double>((3 * i + 1) % points) + rng.uniform());
    curve.n.push_back(n);
    curve.error.push_back(first * std::pow(n, slope) * (1 + 0.5 * rng.uniform()));
  }
  return curve;
}

/// Two methods: square errors a/t and bias2 + b/t.
struct Race {
  double a, b, bias2;
};

inline Race drawn_race(std::uint64_t seed) {
  carlo::Rng rng(seed);
  const double b = 1 + rng.uniform();
  const double a = b + 1 + 3 * rng.uniform();
  return {a, b, 0.1 + 0.3 * rng.uniform()};
}

}  // namespace lab09_tests
