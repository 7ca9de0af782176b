#pragma once

#include <array>
#include <cstdint>
#include <vector>

// What tests of the vector kernel compute on each instruction set: their files are compiled once
// for each.

namespace renderer {

/// Choices of a light for one point each: the random numbers, which light with what probability and
/// what remains of u; then the probability as it is computed for a light that is known.
struct LightChoices {
  std::vector<float> px, py, pz, nx, ny, nz, u;
  std::vector<std::uint32_t> word, light;
  std::vector<float> probability, again;
};

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

// All columns have the same length, a multiple of every number of lanes.
namespace lane_math {

template <class T>
struct Fused {
  std::vector<T> a, b, c, add, sub, neg_add, neg_sub;
};

struct Elementary {
  std::vector<float> x, log, exp, minus_expm1, turns;
};

}  // namespace lane_math
