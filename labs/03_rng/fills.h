#pragma once

// Given: fill() of the generators in rng.cpp, which includes this file at its end. Each is a loop
// over next(), and stands here so that the compiler sees both in one place.

#include "rng.h"

namespace lab03 {

/// A local copy of the state cannot alias `out`, so it stays in registers.
template <class Generator>
void fill_with_copy(Generator& generator, std::span<std::uint32_t> out) {
  Generator local = generator;
  for (std::uint32_t& word : out)
    word = local.next();
  generator = local;
}

// Included by rng.cpp alone, so that each is defined once.
// NOLINTBEGIN(misc-definitions-in-headers)

void Lcg::fill(std::span<std::uint32_t> out) {
  fill_with_copy(*this, out);
}

void Pcg32::fill(std::span<std::uint32_t> out) {
  fill_with_copy(*this, out);
}

void LaggedFibonacci::fill(std::span<std::uint32_t> out) {
  for (std::uint32_t& word : out)
    word = next();
}

// NOLINTEND(misc-definitions-in-headers)

}  // namespace lab03
