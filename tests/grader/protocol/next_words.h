#pragma once

#include "random/rng.h"

#include <array>
#include <cstdint>

namespace carlo::grader {

/// The next 32-bit words of a generator, as part of an answer: they show how far it has advanced. A
/// judge that knows the seed need not believe a reported count.
using NextWords = std::array<double, 4>;

inline NextWords next_words(Rng rng) {
  NextWords words{};
  for (double& word : words)
    word = rng.next_u32();
  return words;
}

/// Returns how many words a generator has given since `before` if `next` are those that follow; -1
/// if they do not occur within `most` words.
inline double words_drawn(Rng before, const NextWords& next, std::int64_t most) {
  NextWords window{};
  for (double& word : window)
    word = before.next_u32();
  for (std::int64_t drawn = 0; drawn <= most; ++drawn) {
    if (window == next) return static_cast<double>(drawn);
    window = {window[1], window[2], window[3], static_cast<double>(before.next_u32())};
  }
  return -1;
}

}  // namespace carlo::grader
