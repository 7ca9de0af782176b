#pragma once

#include <cstdint>
#include <string_view>

namespace carlo {

/// A bijection of 64-bit words in which each output bit depends on every input bit (the finaliser
/// of splitmix64: Steele, Lea, Flood, "Fast splittable pseudorandom number generators", 2014).
constexpr std::uint64_t mix(std::uint64_t x) {
  x += 0x9E3779B97F4A7C15;
  x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9;
  x = (x ^ (x >> 27)) * 0x94D049BB133111EB;
  return x ^ (x >> 31);
}

/// Combines several words into one; the order of the arguments matters.
template <class... Rest>
constexpr std::uint64_t hash(std::uint64_t first, Rest... rest) {
  std::uint64_t h = mix(first);
  ((h = mix(h ^ static_cast<std::uint64_t>(rest))), ...);
  return h;
}

/// Hashes a text (FNV-1a: Fowler, Noll, Vo). Not collision-resistant against an adversary.
constexpr std::uint64_t hash_of(std::string_view text) {
  std::uint64_t h = 0xCBF29CE484222325;
  for (const char c : text)
    h = (h ^ static_cast<unsigned char>(c)) * 0x100000001B3;
  return h;
}

}  // namespace carlo
