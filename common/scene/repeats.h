#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace carlo {

/// Spreads a number's bits over all 64, so that sums of the results are keys of sets. Source:
/// Steele, Lea and Flood, "Fast splittable pseudorandom number generators", 2014 (its mix64).
inline std::uint64_t spread(std::uint64_t x) {
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9;
  x = (x ^ (x >> 27)) * 0x94d049bb133111eb;
  return x ^ (x >> 31);
}

/// Calls repeated(later, earlier) for each thing that equals an earlier one that is not itself a
/// repeat. Things are numbers below keys.size(); equal things have equal keys. Almost nothing in a
/// large mesh is repeated: a table of bits rules out most, and only the rest is sorted.
template <class Same, class Repeated>
void find_repeats(const std::vector<std::uint64_t>& keys, const Same& same,
                  const Repeated& repeated) {
  constexpr std::size_t bits_a_key = 16;
  const std::size_t words = std::bit_ceil(std::max<std::size_t>(keys.size() * bits_a_key / 64, 1));
  std::vector<std::uint64_t> seen(words), seen_again(words);
  const auto word = [&](std::uint64_t key) { return (key >> 6) & (words - 1); };
  const auto bit = [](std::uint64_t key) { return std::uint64_t{1} << (key & 63); };
  for (const std::uint64_t key : keys) {
    seen_again[word(key)] |= seen[word(key)] & bit(key);
    seen[word(key)] |= bit(key);
  }
  std::vector<std::pair<std::uint64_t, std::size_t>> few;
  for (std::size_t i = 0; i < keys.size(); ++i) {
    if ((seen_again[word(keys[i])] & bit(keys[i])) != 0) few.emplace_back(keys[i], i);
  }
  std::sort(few.begin(), few.end());
  std::vector<std::size_t> kept;  // with this key: usually one
  for (std::size_t i = 0; i < few.size(); ++i) {
    if (i == 0 || few[i].first != few[i - 1].first) kept.clear();
    const std::size_t thing = few[i].second;
    const auto earlier = std::find_if(kept.begin(), kept.end(),
                                      [&](std::size_t other) { return same(thing, other); });
    if (earlier == kept.end()) {
      kept.push_back(thing);
    } else {
      repeated(thing, *earlier);
    }
  }
}

}  // namespace carlo
