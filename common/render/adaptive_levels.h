#pragma once

#include "cli/error.h"

#include <algorithm>
#include <bit>
#include <cstdint>

namespace carlo {

/// The samples of a half after a number of rounds: n, 3/2 n, 2 n, 3 n, 4 n ... The samples of each
/// round are aligned runs of a power of two, which Sobol' points fill evenly.
class Levels {
 public:
  explicit Levels(std::uint32_t spp) {
    if (spp < 32) {
      throw Error("--target-error needs at least 32 samples a pixel, got --spp {}", spp);
    }
    first_ = std::min(32u, std::bit_floor(spp / 2));
    while (end(count_) <= spp / 2)
      ++count_;
  }
  int count() const { return count_; }
  std::uint32_t end(int level) const {
    const std::uint32_t octave = first_ << (level / 2);
    return level % 2 == 0 ? octave : octave + octave / 2;
  }
  std::uint32_t begin(int level) const { return level == 0 ? 0 : end(level - 1); }

 private:
  std::uint32_t first_ = 0;
  int count_ = 0;
};

}  // namespace carlo
