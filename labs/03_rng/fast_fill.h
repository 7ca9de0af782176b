#pragma once

#include "rng.h"

#include <array>
#include <cstdint>
#include <span>

namespace lab03 {

// Generators that fill arrays eight or more lanes at a time: with AVX2 where the machine has it,
// otherwise without, with the same numbers. Arrays must hold a multiple of 32 words; anything else
// throws carlo::Error.

/// The sequence of your Lcg: each of 32 lanes makes every 32nd number (leapfrogging).
class LeapfrogLcg {
 public:
  explicit LeapfrogLcg(std::uint32_t seed);
  void fill(std::span<std::uint32_t> out);

 private:
  alignas(32) std::array<std::uint32_t, 32> lanes_{};  ///< the next 32 numbers
  std::uint32_t factor_ = 0, summand_ = 0;             ///< of 32 steps
};

/// Eight xoshiro128++ side by side: word i is from stream i mod 8.
class Xoshiro128x8 {
 public:
  explicit Xoshiro128x8(std::uint64_t seed);
  void fill(std::span<std::uint32_t> out);

 private:
  alignas(32) std::array<std::array<std::uint32_t, 8>, 4> state_{};
};

/// Philox4x32-10, eight blocks at a time: the sequence of carlo::Rng(seed).
class PhiloxBlocks {
 public:
  explicit PhiloxBlocks(std::uint64_t seed);
  void fill(std::span<std::uint32_t> out);

 private:
  std::array<std::uint32_t, 2> key_;
  std::uint64_t position_ = 0;
};

/// True if the machine has AVX2.
bool has_avx2();

/// For tests: behaves as if the machine had no AVX2.
void forbid_avx2(bool forbid);

}  // namespace lab03
