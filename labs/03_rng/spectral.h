#pragma once

#include <cstdint>
#include <vector>

namespace lab03 {

/// The shortest vector of whole numbers with s_0 + a s_1 + a^2 s_2 + ... = 0 mod c, not 0. The
/// points (x_n, x_{n+1}, ...) / c lie on the hyperplanes s . x = integer + const, 1 / |s| apart.
struct DualVector {
  std::vector<std::int64_t> s;
  std::uint64_t squared = 0;  ///< |s|^2 = nu^2

  /// The length, nu.
  double length() const;
  /// How many of the planes s . x = whole number + shift meet the inside of the unit cube: of a
  /// generator without a summand (shift 0) exactly, of others at most.
  std::int64_t planes(bool shifted) const;
};

/// Exact in integers, by trying all vectors that Hermite's bound leaves, in 2, 3 or 4 dimensions.
/// 0 < a < c <= 2^32. In 4 dimensions some 6e7 vectors for c = 2^32. Source: Knuth, "The Art of
/// Computer Programming" 2, section 3.3.4.
DualVector shortest_dual_vector(std::uint64_t a, std::uint64_t c, int dimensions);

}  // namespace lab03
