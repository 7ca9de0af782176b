#pragma once

#include "random/hash.h"
#include "random/philox.h"
#include "random/to_float.h"

#include <array>
#include <cstdint>

namespace carlo {

/// The generator that the labs get: a stream of independent uniform numbers. Two streams with
/// different (seed, stream) never overlap; equal ones give equal numbers on every machine.
/// Counter-based (philox.h), so streams cost nothing to create.
class Rng {
 public:
  explicit Rng(std::uint64_t seed, std::uint64_t stream = 0)
      : key_(split(mix(seed))), stream_(split(stream)) {}

  /// Returns a uniform 32-bit word.
  std::uint32_t next_u32() {
    if (used_ == 4) refill();
    return block_[used_++];
  }

  /// Returns a uniform 64-bit word.
  std::uint64_t next_u64() {
    const std::uint64_t high = next_u32();
    return high << 32 | next_u32();
  }

  /// Returns a uniform double in [0, 1): never 1.
  double uniform() { return to_double(next_u64()); }

  /// Returns a uniform float in [0, 1): never 1.
  float uniform_float() { return to_float(next_u32()); }

 private:
  static std::array<std::uint32_t, 2> split(std::uint64_t x) {
    return {static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(x >> 32)};
  }

  void refill() {
    const auto position = split(position_++);
    block_ = philox4x32({position[0], position[1], stream_[0], stream_[1]}, key_);
    used_ = 0;
  }

  std::array<std::uint32_t, 2> key_;
  std::array<std::uint32_t, 2> stream_;
  std::uint64_t position_ = 0;
  std::array<std::uint32_t, 4> block_{};
  unsigned used_ = 4;
};

}  // namespace carlo
