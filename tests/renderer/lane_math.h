#pragma once

#include <vector>

// What lane_math_test.cpp has computed on each instruction set.
namespace lane_math {

// All columns are as long, a multiple of all numbers of lanes.

template <class T>
struct Fused {
  std::vector<T> a, b, c, add, sub, neg_add, neg_sub;
};

struct Elementary {
  std::vector<float> x, log, exp, minus_expm1, turns;
};

}  // namespace lane_math
