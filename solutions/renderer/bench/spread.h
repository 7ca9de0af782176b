#pragma once

#include <vector>

namespace bench {

/// Median, least and greatest of several runs.
struct Spread {
  double median = 0, least = 0, greatest = 0;
};

/// Of one value at least; of an even number the upper median.
Spread spread(std::vector<double> values);

inline double median(const std::vector<double>& values) {
  return spread(values).median;
}

}  // namespace bench
