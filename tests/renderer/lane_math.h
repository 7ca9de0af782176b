#pragma once

#include <vector>

// Results for lane_math_test.cpp, computed on each instruction set.
namespace lane_math {

// All columns have the same length, a multiple of every number of lanes.

template <class T>
struct Fused {
  std::vector<T> a, b, c, add, sub, neg_add, neg_sub;
};

struct Elementary {
  std::vector<float> x, log, exp, minus_expm1, turns;
};

}  // namespace lane_math
