#pragma once

#include <cstdint>
#include <vector>

namespace lab03 {

/// The shortest nonzero integer vector with s_0 + a s_1 + a^2 s_2 + ... = 0 mod c. The points (x_n,
/// x_{n+1}, ...) / c lie on the hyperplanes s . x = integer + const, 1 / |s| apart.
struct DualVector {
  std::vector<std::int64_t> s;
  std::uint64_t squared = 0;  ///< |s|^2 = nu^2

  /// The length, nu.
  double length() const;
  /// The number of planes s . x = integer + shift that meet the inside of the unit cube: exact for
  /// a generator without a summand (shift 0), an upper bound for others.
  std::int64_t planes(bool shifted) const;
};

/// Exact in integers, by trying all vectors within Hermite's bound, in 2, 3 or 4 dimensions. 0 < a
/// < c <= 2^32. About 6e7 vectors in 4 dimensions for c = 2^32. Source: Knuth, "The Art of Computer
/// Programming" 2, section 3.3.4.
DualVector shortest_dual_vector(std::uint64_t a, std::uint64_t c, int dimensions);

}  // namespace lab03
