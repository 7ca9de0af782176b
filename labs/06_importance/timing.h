#pragma once

#include <algorithm>
#include <chrono>
#include <cstdint>

namespace lab06 {

/// Seconds that one of `count` samples takes: the best of three rounds of work(), which draws all.
/// What it returns is kept from being optimised away.
template <class Work>
double seconds_a_sample(std::int64_t count, const Work& work) {
  double best = 1e9;
  [[maybe_unused]] volatile double sink = 0;
  for (int round = 0; round < 3; ++round) {
    const auto start = std::chrono::steady_clock::now();
    sink = work();
    const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - start;
    best = std::min(best, spent.count());
  }
  return best / static_cast<double>(count);
}

}  // namespace lab06
