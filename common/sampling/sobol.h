#pragma once

#include "numeric/vec.h"
#include "random/to_float.h"

#include <cstdint>

namespace carlo {

constexpr std::uint32_t reverse_bits(std::uint32_t x) {
  x = __builtin_bswap32(x);
  x = (x & 0x0F0F0F0F) << 4 | (x >> 4 & 0x0F0F0F0F);
  x = (x & 0x33333333) << 2 | (x >> 2 & 0x33333333);
  return (x & 0x55555555) << 1 | (x >> 1 & 0x55555555);
}

/// Returns the second coordinate of the index-th point of the Sobol' sequence as a 32-bit fraction;
/// the first is reverse_bits(index). Its generator matrix is Pascal's triangle modulo 2, whose
/// product with a bit vector is a sum over supersets: five shifts instead of 32 table look-ups.
constexpr std::uint32_t sobol_second(std::uint32_t index) {
  index ^= index >> 1 & 0x55555555;
  index ^= index >> 2 & 0x33333333;
  index ^= index >> 4 & 0x0F0F0F0F;
  index ^= index >> 8 & 0x00FF00FF;
  index ^= index >> 16;
  return reverse_bits(index);
}

/// A random permutation in which each bit is flipped by a hash of the bits below it: applied to a
/// bit-reversed fraction it is Owen's nested uniform scrambling.
/// Source: Laine and Karras, "Stratified sampling for stochastic transparency", EGSR 2011, with the
/// constants of N. Vegdahl's search (psychopath.io, "Building a better LK hash").
constexpr std::uint32_t nested_hash(std::uint32_t x, std::uint32_t seed) {
  x ^= x * 0x3D20ADEA;
  x += seed;
  x *= (seed >> 16) | 1;
  x ^= x * 0x05526C56;
  x ^= x * 0x53A22864;
  return x;
}

/// Applies Owen scrambling to a 32-bit fraction.
constexpr std::uint32_t owen_scramble(std::uint32_t fraction, std::uint32_t seed) {
  return reverse_bits(nested_hash(reverse_bits(fraction), seed));
}

/// Returns the index-th point of a 2D Sobol' sequence, with shuffled order and scrambled
/// coordinates, by three independent seeds. The points of any aligned block of 2^m indices are a
/// (0, m, 2)-net, and two sequences with different seeds are independent, so that pairs of
/// dimensions may be padded.
/// Source: Burley, "Practical hash-based Owen scrambling", JCGT 9(4), 2020.
constexpr Vec2 shuffled_sobol_2d(std::uint32_t index, std::uint32_t shuffle_seed,
                                 std::uint32_t x_seed, std::uint32_t y_seed) {
  // Scrambling the bit-reversal of the index shuffles it; that reversal is also the first
  // coordinate.
  const std::uint32_t x = nested_hash(reverse_bits(index), shuffle_seed);
  const std::uint32_t y = sobol_second(reverse_bits(x));
  return {to_float(owen_scramble(x, x_seed)), to_float(owen_scramble(y, y_seed))};
}

}  // namespace carlo
