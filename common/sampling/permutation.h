#pragma once

#include "random/hash.h"

#include <bit>
#include <cstdint>

namespace carlo {

/// Up to this size permute() draws all n! permutations equally often.
constexpr std::uint32_t most_ranked = 12;

/// Returns n!, n up to most_ranked.
constexpr std::uint64_t factorial(std::uint32_t n) {
  std::uint64_t product = 1;
  for (std::uint32_t k = 2; k <= n; ++k)
    product *= k;
  return product;
}

/// Returns the image of i under the permutation of {0, ..., n - 1} with this rank in lexical order;
/// i < n <= most_ranked, rank < n!.
constexpr std::uint32_t permute_by_rank(std::uint32_t i, std::uint32_t n, std::uint64_t rank) {
  std::uint32_t left = (1u << n) - 1;  // bit k: k is not an image yet
  for (std::uint32_t place = 0;; ++place) {
    const std::uint64_t below = factorial(n - 1 - place);
    std::uint32_t bits = left;
    for (std::uint64_t skip = rank / below; skip > 0; --skip)
      bits &= bits - 1;
    const auto image = static_cast<std::uint32_t>(std::countr_zero(bits));
    if (place == i) return image;
    rank %= below;
    left &= ~(1u << image);
  }
}

/// The same for any n, under a permutation made of random exchanges: in each round every element
/// and its mirror image about a random point are exchanged or not, by a coin of their own. An
/// element or pair retains information about its origin with probability only 2^-rounds.
/// Source: Hoang, Morris, Rogaway, "An enciphering scheme based on a card shuffle", CRYPTO 2012.
constexpr std::uint32_t permute_by_exchanges(std::uint32_t i, std::uint32_t n, std::uint64_t seed) {
  constexpr std::uint64_t rounds = 32;
  for (std::uint64_t round = 0; round < rounds; ++round) {
    const std::uint64_t key = hash(seed, round);
    const std::uint64_t turn = (key >> 32) * n >> 32;
    const auto partner = static_cast<std::uint32_t>((turn + n - i) % n);
    if ((mix(key ^ (i > partner ? i : partner)) & 1) != 0) i = partner;
  }
  return i;
}

/// Returns the image of i under a random permutation of {0, ..., n - 1} chosen by `seed`, whose 64
/// bits must be uniform (a hash); i < n. For n up to most_ranked every permutation has the same
/// share of the seeds to within one part in 2^35; above, no count shows any preference in where an
/// element or a pair of elements goes.
constexpr std::uint32_t permute(std::uint32_t i, std::uint32_t n, std::uint64_t seed) {
  if (n > most_ranked) return permute_by_exchanges(i, n, seed);
  // rank = floor(seed n! / 2^64), in halves: n! < 2^29.
  const std::uint64_t count = factorial(n);
  const std::uint64_t low = (seed & 0xFFFFFFFF) * count >> 32;
  return permute_by_rank(i, n, ((seed >> 32) * count + low) >> 32);
}

}  // namespace carlo
