#pragma once

#include "numeric/vec.h"

#include <cstddef>
#include <cstdint>
#include <vector>

/// Measures how well points are distributed, by Walsh functions: products of the signs of binary
/// digits.
namespace walsh {

/// The digits of a point that are used: the first three of each coordinate.
constexpr std::uint32_t digits = 6, codes = 1u << digits;

inline std::uint32_t code_of(carlo::Vec2 p) {
  return static_cast<std::uint32_t>(p.x * 8) << 3 | static_cast<std::uint32_t>(p.y * 8);
}

/// Replaces the number of times each code occurs by the sum of each Walsh function.
inline void transform(std::vector<double>& values) {
  for (std::size_t half = 1; half < values.size(); half *= 2) {
    for (std::size_t i = 0; i < values.size(); ++i) {
      if ((i & half) != 0) continue;
      const double a = values[i], b = values[i | half];
      values[i] = a + b, values[i | half] = a - b;
    }
  }
}

/// The largest gains: n times the variance of the mean of a Walsh function, which is 1 for
/// independent points.
struct Gains {
  double pair = 0;     ///< for functions of one dimension pair
  double product = 0;  ///< for products of functions of two
};

/// Over `draws` draws of n points in four dimensions: points(draw, pair, i) is the i-th point's
/// pair 0 or 1.
template <class Points>
Gains worst_gains(std::uint32_t n, std::uint64_t draws, const Points& points) {
  std::vector<double> mean_squares(codes * codes), sums(codes * codes);
  for (std::uint64_t draw = 0; draw < draws; ++draw) {
    sums.assign(sums.size(), 0);
    for (std::uint32_t i = 0; i < n; ++i)
      sums[code_of(points(draw, 0, i)) << digits | code_of(points(draw, 1, i))] += 1;
    transform(sums);
    for (std::size_t w = 0; w < sums.size(); ++w)
      mean_squares[w] += sums[w] * sums[w] / n / static_cast<double>(draws);
  }
  Gains worst;
  for (std::size_t w = 1; w < mean_squares.size(); ++w) {
    const bool product = w >= codes && w % codes != 0;
    double& largest = product ? worst.product : worst.pair;
    if (mean_squares[w] > largest) largest = mean_squares[w];
  }
  return worst;
}

}  // namespace walsh
