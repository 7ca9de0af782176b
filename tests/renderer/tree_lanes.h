#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace renderer {
/// A ray's origin, direction and length, the surface that it starts on and the way to there; then
/// what it meets, and whether something blocks it.
struct TriedRay {
  std::array<float, 3> o, d, arrival;
  float length;
  std::uint32_t last, plane;
  float t;
  std::uint32_t surface, blocked;
};
struct Found {
  std::vector<TriedRay> by_tree, by_all;
};
}  // namespace renderer
