#pragma once

#include <array>
#include <cassert>
#include <cstddef>
#include <cstdint>

namespace carlo {

/// Mirrors the digits of `index` in `base` at the radix point: 6 = 110 in base 2 gives 0.011 = 3/8.
/// base >= 2. If index * base < 2^53, the result lies in [0, 1) and is the double nearest to the
/// exact fraction, because the digits are collected in an integer and divided once.
constexpr double radical_inverse(std::uint32_t base, std::uint64_t index) {
  std::uint64_t mirrored = 0, denominator = 1;
  while (index > 0) {
    mirrored = mirrored * base + index % base;
    denominator *= base;
    index /= base;
  }
  return static_cast<double>(mirrored) / static_cast<double>(denominator);
}

/// The bases of Halton's sequence: the first primes, one per dimension.
inline constexpr std::array<std::uint32_t, 16> halton_bases = {2,  3,  5,  7,  11, 13, 17, 19,
                                                               23, 29, 31, 37, 41, 43, 47, 53};

/// Returns coordinate `dimension` of point `index` of Halton's sequence; dimension <
/// halton_bases.size().
/// Source: Halton, "On the efficiency of certain quasi-random sequences of points in evaluating
/// multi-dimensional integrals", Numerische Mathematik 2, 1960.
constexpr double halton(std::uint64_t index, std::size_t dimension) {
  assert(dimension < halton_bases.size());
  return radical_inverse(halton_bases[dimension], index);
}

/// Moves x by `shift` around the circle of length 1; both in [0, 1), and so is the result. With the
/// same uniform random shift for all values of one coordinate, every point is uniform and the set
/// keeps its even spacing.
/// Source: Cranley and Patterson, "Randomization of number theoretic methods for multiple
/// integration", SIAM Journal on Numerical Analysis 13, 1976.
constexpr double rotated(double x, double shift) {
  // x + shift - 1 in two roundings could give 1; 1 - shift is exact for multiples of 2^-53.
  return x < 1 - shift ? x + shift : x - (1 - shift);
}

}  // namespace carlo
