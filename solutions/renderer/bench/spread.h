#pragma once

#include <algorithm>
#include <vector>

namespace bench {

/// Median, least and greatest of several runs.
struct Spread {
  double median = 0, least = 0, greatest = 0;
};

/// Needs at least one value; for an even number takes the upper median.
inline Spread spread(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return {values[values.size() / 2], values.front(), values.back()};
}

inline double median(const std::vector<double>& values) {
  return spread(values).median;
}

}  // namespace bench
