#pragma once

#include "grader/protocol/params.h"
#include "random/rng.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace lab03_tests {

/// A 64-bit word as two numbers of a probe's parameters, each of which a double holds: "seed_high"
/// and "seed_low" for the name "seed".
inline std::uint64_t wide_word(const carlo::grader::Params& params, const std::string& name) {
  return static_cast<std::uint64_t>(params.whole(name + "_high")) << 32 |
         static_cast<std::uint64_t>(params.whole(name + "_low"));
}

inline void set_wide_word(carlo::grader::Params& params, const std::string& name,
                          std::uint64_t word) {
  params.numbers[name + "_high"] = static_cast<double>(word >> 32);
  params.numbers[name + "_low"] = static_cast<double>(word & 0xFFFFFFFF);
}

/// n words that follow from a probe's seed, so that the judge knows them.
inline std::vector<std::uint32_t> random_words(std::uint64_t seed, std::int64_t n) {
  carlo::Rng rng(seed);
  std::vector<std::uint32_t> words(static_cast<std::size_t>(n));
  for (std::uint32_t& word : words)
    word = rng.next_u32();
  return words;
}

/// The words used to test a conversion: the first 4096, the last 4096 and n between them.
inline std::vector<std::uint32_t> words_to_convert(std::int64_t n) {
  std::vector<std::uint32_t> words;
  for (std::uint32_t i = 0; i < 4096; ++i)
    words.push_back(i);
  for (std::int64_t i = 1; i <= n; ++i)
    words.push_back(static_cast<std::uint32_t>(4'294'000'000.0 / static_cast<double>(n + 1) *
                                               static_cast<double>(i)));
  for (std::uint32_t i = 0; i < 4096; ++i)
    words.push_back(0xFFFFF000 + i);
  return words;
}

/// The words around the seven multiples of 2^32 / 6, n to either side: they include the left-over
/// words for the ranges and methods that checks_use.cpp names.
inline std::vector<std::uint32_t> words_to_deal(std::int64_t n) {
  std::vector<std::uint32_t> words;
  for (std::int64_t i = 0; i <= 6; ++i) {
    const std::int64_t centre = (i << 32) / 6;
    for (std::int64_t word = centre - n; word < centre + n; ++word) {
      if (word >= 0 && word < std::int64_t{1} << 32)
        words.push_back(static_cast<std::uint32_t>(word));
    }
  }
  return words;
}

}  // namespace lab03_tests
