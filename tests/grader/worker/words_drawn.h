#pragma once

#include "random/rng.h"

#include <array>
#include <cstdint>

namespace carlo::grader {

/// How many 32-bit words the generator `after` has given since it was `before`: found by where its
/// next four words stand in the stream. -1 when they do not come within `most` words.
inline double words_drawn(Rng before, Rng after, std::int64_t most) {
  std::array<std::uint32_t, 4> next{}, window{};
  for (auto& word : next)
    word = after.next_u32();
  for (auto& word : window)
    word = before.next_u32();
  for (std::int64_t drawn = 0; drawn <= most; ++drawn) {
    if (window == next) return static_cast<double>(drawn);
    window = {window[1], window[2], window[3], before.next_u32()};
  }
  return -1;
}

}  // namespace carlo::grader
