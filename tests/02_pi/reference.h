#pragma once

// What the exercises of lab 02 must count, written for plainness and not for speed; and a look at
// how far a generator has come.

#include "pi.h"

#include <array>
#include <cmath>
#include <cstdint>

namespace lab02_tests {

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

/// Where in its cell a dart of Lab 2.5 is taken to lie, as a share of the cell: the centre.
constexpr double centre = 0.5;

/// Whether dart i of `key` hits. In units of half a cell every place is a whole number, so there is
/// no rounding.
inline bool hit(std::uint64_t key, std::int64_t i, double place = centre) {
  const std::uint64_t word = lab02::dart_word(key, i / 2);
  const std::uint64_t dart = i % 2 == 0 ? word & 0xFFFFFFFF : word >> 32;
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

/// How many 32-bit words `after` has given since it was `before`, found by where its next four
/// stand in the stream; -1 when they do not come within `most` words.
inline double words_drawn(carlo::Rng before, carlo::Rng after, std::int64_t most) {
  std::array<std::uint32_t, 4> next{}, window{};
  for (auto& word : next)
    word = after.next_u32();
  for (auto& word : window)
    word = before.next_u32();
  for (std::int64_t drawn = 0; drawn <= most; ++drawn) {
    if (window == next) return static_cast<double>(drawn);
    window = {window[1], window[2], window[3], before.next_u32()};
  }
  return -1;
}

}  // namespace lab02_tests
