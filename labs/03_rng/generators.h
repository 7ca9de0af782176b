#pragma once

#include "rng.h"

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace lab03 {

/// xoshiro128++ 1.0. Source: Blackman and Vigna, "Scrambled linear pseudorandom number generators",
/// 2021; prng.di.unimi.it. The state must not be all zero.
class Xoshiro128 {
 public:
  explicit Xoshiro128(std::array<std::uint32_t, 4> state) : s_(state) {}
  /// The state comes from splitmix64, as its authors advise.
  explicit Xoshiro128(std::uint64_t seed);

  std::uint32_t next() {
    const std::uint32_t result = rotated(s_[0] + s_[3], 7) + s_[0];
    const std::uint32_t shifted = s_[1] << 9;
    s_[2] ^= s_[0];
    s_[3] ^= s_[1];
    s_[1] ^= s_[2];
    s_[0] ^= s_[3];
    s_[2] ^= shifted;
    s_[3] = rotated(s_[3], 11);
    return result;
  }

  const std::array<std::uint32_t, 4>& state() const { return s_; }

 private:
  static std::uint32_t rotated(std::uint32_t x, int by) { return (x << by) | (x >> (32 - by)); }

  std::array<std::uint32_t, 4> s_;
};

/// splitmix64. Source: Steele, Lea, Flood, "Fast splittable pseudorandom number generators", 2014.
class SplitMix64 {
 public:
  explicit SplitMix64(std::uint64_t seed) : state_(seed) {}

  std::uint64_t next() {
    state_ += 0x9E3779B97F4A7C15;
    std::uint64_t z = state_;
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EB;
    return z ^ (z >> 31);
  }

 private:
  std::uint64_t state_;
};

/// Writes the next numbers of a stream.
using Fill = std::function<void(std::span<std::uint32_t>)>;

/// A generator by name. Its numbers have `bits` bits and stand at the top of the word: those of a
/// 31-bit generator are shifted left by one.
struct Generator {
  std::string key;   ///< for command lines: "lfg-24-55-add"
  std::string name;  ///< for display: "LFG (24, 55) +"
  int bits = 32;
  Lags lags{24, 55};                        ///< its own if it has lags, otherwise those tried on it
  std::function<Fill(std::uint64_t)> make;  ///< makes the stream for that seed
};

/// The lecture's LCG, RANDU, MINSTD, lagged Fibonacci for the lecture's lags with +, - and xor,
/// PCG32, and for comparison with your own work mt19937, xoshiro128++, Philox and splitmix64.
const std::vector<Generator>& generators();

/// The generator with that key. Throws carlo::Error listing all keys.
const Generator& find_generator(std::string_view key);

/// Writes the numbers of a generator to standard output for an external battery: 32-bit
/// little-endian words, until the reader closes the pipe. Throws carlo::Error when the generator is
/// unknown, when standard output is a terminal, or when writing fails for any other reason.
void write_raw_stream(const std::string& key, std::uint64_t seed);

}  // namespace lab03
