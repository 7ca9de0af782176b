#pragma once

#include <bit>
#include <cstdint>

namespace carlo {

/// The image of i under a pseudo-random permutation of {0, ..., n - 1} chosen by `seed`; i < n.
/// A bijection of the next power of two, walked until it lands below n (less than two steps on
/// average). Idea: Kensler, "Correlated multi-jittered sampling", Pixar TM 13-01, 2013.
constexpr std::uint32_t permute(std::uint32_t i, std::uint32_t n, std::uint32_t seed) {
  if (n <= 1) return 0;
  const std::uint32_t mask = std::bit_ceil(n) - 1;
  const int half = std::bit_width(mask) / 2 + 1;
  do {
    std::uint32_t key = seed;
    for (int round = 0; round < 4; ++round) {
      key = key * 0x9E3779B1 + 0x85EBCA6B;
      key ^= key >> 15;
      // Each step is a bijection of the masked words: xor, odd multiple, xor with a right shift.
      i ^= key & mask;
      i = (i * (key >> 8 | 1)) & mask;
      i ^= i >> half;
      i = (i + (key >> 19)) & mask;
    }
  } while (i >= n);
  return i;
}

}  // namespace carlo
