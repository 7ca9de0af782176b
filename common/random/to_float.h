#pragma once

#include <cstdint>

namespace carlo {

/// Returns a float in [0, 1): one of the 2^24 multiples of 2^-24, all equally likely for a uniform
/// word. Multiplying all 32 bits by 2^-32 would round the 128 largest words up to 1.
constexpr float to_float(std::uint32_t word) {
  return static_cast<float>(word >> 8) * 0x1p-24f;
}

/// Returns a double in [0, 1): one of the 2^53 multiples of 2^-53.
constexpr double to_double(std::uint64_t word) {
  return static_cast<double>(word >> 11) * 0x1p-53;
}

}  // namespace carlo
