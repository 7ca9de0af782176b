#include "random/hash.h"
#include "random/philox.h"
#include "random/rng.h"
#include "random/to_float.h"

#include <catch2/catch_test_macros.hpp>

#include <cmath>
#include <set>

namespace {

using namespace carlo;

TEST_CASE("Philox4x32-10 gives the known answers of its authors") {
  // Random123's kat_vectors, philox 4x32 10.
  CHECK(philox4x32({0, 0, 0, 0}, {0, 0}) ==
        std::array<std::uint32_t, 4>{0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8});
  CHECK(philox4x32({0xffffffff, 0xffffffff, 0xffffffff, 0xffffffff}, {0xffffffff, 0xffffffff}) ==
        std::array<std::uint32_t, 4>{0x408f276d, 0x41c83b0e, 0xa20bc7c6, 0x6d5451fd});
  CHECK(philox4x32({0x243f6a88, 0x85a308d3, 0x13198a2e, 0x03707344}, {0xa4093822, 0x299f31d0}) ==
        std::array<std::uint32_t, 4>{0xd16cfe09, 0x94fdcceb, 0x5001e420, 0x24126ea1});
}

TEST_CASE("Floats and doubles made from the largest word stay below 1") {
  CHECK(to_float(0xFFFFFFFF) < 1.0f);
  CHECK(to_float(0xFFFFFFFF) == 1.0f - 0x1p-24f);
  CHECK(to_double(~std::uint64_t{0}) < 1.0);
  CHECK(to_float(0) == 0.0f);
}

TEST_CASE("Every float of the grid has the same number of words") {
  // 2^8 words map to each of the 2^24 floats, including the top float, which clamping would favour.
  CHECK(to_float(0xFFFFFF00) == to_float(0xFFFFFFFF));
  CHECK(to_float(0xFFFFFEFF) < to_float(0xFFFFFF00));
}

TEST_CASE("mix() is a bijection on a large sample and hash() depends on the order") {
  std::set<std::uint64_t> seen;
  for (std::uint64_t i = 0; i < 100000; ++i)
    seen.insert(mix(i));
  CHECK(seen.size() == 100000);
  CHECK(hash(1, 2) != hash(2, 1));
}

TEST_CASE("Streams of small consecutive seeds are uncorrelated and uniform") {
  // Hard case 25: with seeds 1, 2, 3, ... some generators give first numbers proportional to the
  // seed. n = 1e5 first numbers: the mean has standard deviation 9.1e-4, |z| < 5 is alpha = 6e-7.
  constexpr int n = 100000;
  double sum = 0, product = 0, previous = 0.5;
  for (int seed = 0; seed < n; ++seed) {
    const double u = Rng(static_cast<std::uint64_t>(seed)).uniform();
    sum += u;
    product += (u - 0.5) * (previous - 0.5);
    previous = u;
  }
  CHECK(std::abs(sum / n - 0.5) <= 5 * std::sqrt(1.0 / 12 / n));
  CHECK(std::abs(product / n) <= 5 / 12.0 / std::sqrt(n));
}

TEST_CASE("A stream repeats itself, and another stream or seed differs") {
  Rng a(7), b(7), c(8), d(7, 1);
  const std::uint64_t first = a.next_u64();
  CHECK(first == b.next_u64());
  CHECK(first != c.next_u64());
  CHECK(first != d.next_u64());
}

TEST_CASE("Each of the 64 bits of a seed and of a stream counts") {
  // NumPy 2.2.6 takes the seeds [7, 3, 0] and [7, 3] as one, and 2^32 + 5 as [5, 1].
  std::set<std::uint64_t> first{Rng(7).next_u64()};
  for (int bit = 0; bit < 64; ++bit) {
    first.insert(Rng(7 ^ std::uint64_t{1} << bit).next_u64());
    first.insert(Rng(7, std::uint64_t{1} << bit).next_u64());
  }
  CHECK(first.size() == 129);
}

TEST_CASE("A stream begins with its counter at 0") {
  // NumPy 2.2.6's Philox begins with its counter + 1.
  const std::uint64_t key = mix(7);
  Rng rng(7, 3);
  for (std::uint32_t block = 0; block < 3; ++block) {
    for (const std::uint32_t word :
         philox4x32({block, 0, 3, 0},
                    {static_cast<std::uint32_t>(key), static_cast<std::uint32_t>(key >> 32)}))
      CHECK(rng.next_u32() == word);
  }
}

}  // namespace
