#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace lab05 {

// Given to you for Labs 5.5 and 5.6: the n bins [i/n, (i+1)/n) of [0, 1), with their edges rounded
// to double. (i + fraction)/n and floor(n x) each round independently, and occasionally put a point
// into the neighbouring bin, which may be one without density. The two functions below agree.

inline double bin_edge(std::size_t i, std::size_t n) {
  return static_cast<double>(i) / static_cast<double>(n);
}

/// The bin that holds x; 0 <= x < 1.
inline std::size_t bin_of(double x, std::size_t n) {
  auto i = static_cast<std::size_t>(x * static_cast<double>(n));
  if (x < bin_edge(i, n)) --i;
  if (x >= bin_edge(i + 1, n)) ++i;
  return i;
}

/// The point at `fraction`, in [0, 1), of the way across bin i; always within the bin.
inline double place_in_bin(std::size_t i, double fraction, std::size_t n) {
  const double x = (static_cast<double>(i) + fraction) / static_cast<double>(n);
  return std::clamp(x, bin_edge(i, n), std::nextafter(bin_edge(i + 1, n), 0.0));
}

}  // namespace lab05
