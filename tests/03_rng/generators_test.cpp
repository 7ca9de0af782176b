// Known answers of every generator, and fast fills against the plain ones.

#include "generators.h"

#include "fast_fill.h"
#include "random/philox.h"
#include "random/rng.h"

#include <catch2/catch_test_macros.hpp>

#include <random>
#include <set>

using namespace lab03;

namespace {

std::vector<std::uint32_t> words(const Fill& fill, std::size_t n) {
  std::vector<std::uint32_t> result(n);
  fill(result);
  return result;
}

template <class Fast>
std::vector<std::uint32_t> fast_words(Fast fast, std::size_t n) {
  std::vector<std::uint32_t> result(n);
  // In several parts, so that the state between them matters.
  const std::span<std::uint32_t> all(result);
  fast.fill(all.first(32));
  fast.fill(all.subspan(32, 96));
  fast.fill(all.subspan(128));
  return result;
}

}  // namespace

// The authors' C code, prng.di.unimi.it, from the state 1, 2, 3, 4.
TEST_CASE("xoshiro128++ gives the numbers of its reference implementation") {
  Xoshiro128 generator(std::array<std::uint32_t, 4>{1, 2, 3, 4});
  for (const std::uint32_t expected :
       {641u, 1573767u, 3222811527u, 3517856514u, 836907274u, 4247214768u, 3867114732u, 1355841295u,
        495546011u, 621204420u})
    CHECK(generator.next() == expected);
}

TEST_CASE("splitmix64 gives the numbers of its reference implementation") {
  SplitMix64 generator(1234567);
  for (const std::uint64_t expected :
       {6457827717110365317u, 3203168211198807973u, 9817491932198370423u, 4593380528125082431u,
        16408922859458223821u})
    CHECK(generator.next() == expected);
}

// Random123's kat_vectors.
TEST_CASE("Philox gives its authors' known answers") {
  CHECK(carlo::philox4x32({0, 0, 0, 0}, {0, 0}) ==
        std::array<std::uint32_t, 4>{0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8});
  CHECK(carlo::philox4x32({0xffffffff, 0xffffffff, 0xffffffff, 0xffffffff},
                          {0xffffffff, 0xffffffff}) ==
        std::array<std::uint32_t, 4>{0x408f276d, 0x41c83b0e, 0xa20bc7c6, 0x6d5451fd});
}

// MINSTD: Park and Miller, "Random number generators: good ones are hard to find", 1988. The
// others: the C++ standard, and RANDU's published beginning 1, 65539, 393225, 1769499, 7077969.
TEST_CASE("MINSTD, mt19937 and RANDU give their published numbers") {
  std::minstd_rand0 minstd;
  minstd.discard(9999);
  CHECK(minstd() == 1043618065);
  std::mt19937 twister;
  twister.discard(9999);
  CHECK(twister() == 4123659995);
  std::linear_congruential_engine<std::uint32_t, 65539, 0, 2147483648u> randu(1);
  for (const std::uint32_t expected : {65539u, 393225u, 1769499u, 7077969u})
    CHECK(randu() == expected);
}

TEST_CASE("a stream follows from its seed alone, and seeds give different streams") {
  for (const Generator& generator : generators()) {
    INFO(generator.name);
    const auto once = words(generator.make(7), 1000);
    CHECK(once == words(generator.make(7), 1000));
    std::set<std::vector<std::uint32_t>> different;
    for (std::uint64_t seed = 0; seed < 100; ++seed)
      different.insert(words(generator.make(seed), 4));
    CHECK(different.size() == 100);
    CHECK(find_generator(generator.key).name == generator.name);
    if (generator.bits == 31) {
      for (const std::uint32_t word : once)
        REQUIRE(word % 2 == 0);
    }
  }
  CHECK_THROWS_AS(find_generator("dice"), carlo::Error);
}

TEST_CASE("a stream filled in parts is the stream filled at once") {
  for (const Generator& generator : generators()) {
    INFO(generator.name);
    const auto whole = words(generator.make(3), 300);
    std::vector<std::uint32_t> parts(300);
    const Fill fill = generator.make(3);
    fill(std::span(parts).first(1));
    fill(std::span(parts).subspan(1, 122));
    fill(std::span(parts).subspan(123));
    CHECK(parts == whole);
  }
}

TEST_CASE("fast fills give the plain sequences, with AVX2 and without") {
  constexpr std::size_t n = 4096;
  std::vector<std::uint32_t> lcg(n), philox(n);
  Lcg(99).fill(lcg);
  carlo::Rng rng(99);
  for (std::uint32_t& word : philox)
    word = rng.next_u32();
  // Each of the eight streams separately: the state of stream i is the i-th four words of
  // splitmix64.
  std::vector<std::uint32_t> xoshiro(n);
  SplitMix64 seeds(99);
  for (std::size_t lane = 0; lane < 8; ++lane) {
    std::array<std::uint32_t, 4> state{};
    for (std::uint32_t& word : state)
      word = static_cast<std::uint32_t>(seeds.next() >> 32);
    Xoshiro128 one(state);
    for (std::size_t i = lane; i < n; i += 8)
      xoshiro[i] = one.next();
  }
  for (const bool forbidden : {true, false}) {
    forbid_avx2(forbidden);
    INFO("AVX2: " << has_avx2());
    CHECK(fast_words(LeapfrogLcg(99), n) == lcg);
    CHECK(fast_words(PhiloxBlocks(99), n) == philox);
    CHECK(fast_words(Xoshiro128x8(99), n) == xoshiro);
  }
  std::vector<std::uint32_t> odd(33);
  CHECK_THROWS_AS(LeapfrogLcg(1).fill(odd), carlo::Error);
}
