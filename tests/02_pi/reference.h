#pragma once

// The right answers of lab 2 for a seed, written for clarity, not for speed. The judge computes
// them itself, since expected values from a worker may be forged.

#include "random/hash.h"
#include "random/rng.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>

namespace lab02_tests {

/// A count as a value of a row.
inline double number(std::int64_t count) {
  return static_cast<double>(count);
}

/// The hits among n darts of `rng`: x first, then y.
inline std::int64_t hits_of(std::int64_t n, carlo::Rng& rng) {
  std::int64_t hits = 0;
  for (std::int64_t i = 0; i < n; ++i) {
    const double x = rng.uniform();
    const double y = rng.uniform();
    hits += x * x + y * y < 1 ? 1 : 0;
  }
  return hits;
}

/// The integrands of Lab 2.3.
enum class Integrand { circle, arctangent };

inline double evaluate(Integrand which, double x) {
  return which == Integrand::circle ? 4 * std::sqrt(1 - x * x) : 4 / (1 + x * x);
}

/// A number of samples, their sum and the sum of their squares.
template <class Real>
struct Totals {
  std::int64_t count = 0;
  Real sum = 0;
  Real squares = 0;
};

/// For n values of an integrand at the numbers of `rng`.
inline Totals<long double> totals_of(Integrand which, std::int64_t n, carlo::Rng& rng) {
  Totals<long double> totals{n};
  for (std::int64_t i = 0; i < n; ++i) {
    const auto y = static_cast<long double>(evaluate(which, rng.uniform()));
    totals.sum += y;
    totals.squares += y * y;
  }
  return totals;
}

/// The position of a dart of Lab 2.5 in its cell, as a fraction of the cell: the centre.
constexpr double centre = 0.5;

/// Dart i of `key`: x in the low 16 bits, y in the high ones.
inline std::uint32_t dart_of(std::uint64_t key, std::int64_t i) {
  const std::uint64_t word =
      carlo::mix(key + static_cast<std::uint64_t>(i / 2) * 0x9E3779B97F4A7C15);
  return static_cast<std::uint32_t>(i % 2 == 0 ? word : word >> 32);
}

/// True if dart i of `key` hits. In units of half a cell every position is a whole number, so
/// nothing is rounded.
inline bool hit(std::uint64_t key, std::int64_t i, double place = centre) {
  const std::uint32_t dart = dart_of(key, i);
  const double x = static_cast<double>(dart & 0xFFFF) + place;
  const double y = static_cast<double>(dart >> 16) + place;
  return x * x + y * y < 65536.0 * 65536.0;
}

/// The hits among the darts first ... first + n - 1 of `key`.
inline std::int64_t hits_of(std::uint64_t key, std::int64_t first, std::int64_t n,
                            double place = centre) {
  std::int64_t hits = 0;
  for (std::int64_t i = first; i < first + n; ++i)
    hits += hit(key, i, place) ? 1 : 0;
  return hits;
}

/// The hits of the loop that fast darts are compared with: only its time matters.
inline std::int64_t plain_loop(std::uint64_t seed, std::int64_t n) {
  std::mt19937 generator(static_cast<std::uint32_t>(seed));
  std::uniform_real_distribution<double> uniform(0, 1);
  std::int64_t hits = 0;
  for (std::int64_t i = 0; i < n; ++i) {
    const double x = uniform(generator);
    const double y = uniform(generator);
    if (x * x + y * y < 1) ++hits;
  }
  return hits;
}

/// The sampler of Lab 2.6: sums whose rounding depends on the order in which they are added.
inline Totals<double> sample(std::int64_t n, carlo::Rng& rng) {
  Totals<double> totals{n};
  for (std::int64_t i = 0; i < n; ++i) {
    const double y = 1 / (1e-3 + rng.uniform());
    totals.sum += y;
    totals.squares += y * y;
  }
  return totals;
}

/// The random numbers of a chunk: its own, or, by mistake, always the first chunk's.
enum class Streams { own, the_first };

/// The totals for that sampler in the order of Lab 2.6's contract, one chunk after the other.
inline Totals<double> totals_by_chunks(std::int64_t n, std::uint64_t seed,
                                       Streams streams = Streams::own) {
  constexpr std::int64_t chunk = 1 << 14;
  Totals<double> totals;
  for (std::int64_t i = 0; i * chunk < n; ++i) {
    carlo::Rng rng(seed, static_cast<std::uint64_t>(streams == Streams::own ? i : 0));
    const Totals<double> part = sample(std::min(chunk, n - i * chunk), rng);
    totals.count += part.count;
    totals.sum += part.sum;
    totals.squares += part.squares;
  }
  return totals;
}

}  // namespace lab02_tests
