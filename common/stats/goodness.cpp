#include "stats/goodness.h"

#include "stats/distributions.h"

#include <cstddef>
#include <limits>
#include <vector>

namespace carlo {

Goodness no_fit() {
  return {std::numeric_limits<double>::infinity(), 0, 0};
}

Goodness pooled_goodness(std::span<const double> counts, std::span<const double> expected) {
  struct Pool {
    double found = 0, expected = 0;
  };
  constexpr double enough = 100;
  std::vector<Pool> pools;
  Pool pending;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    pending.found += counts[i];
    pending.expected += expected[i];
    if (pending.expected < enough) continue;
    pools.push_back(pending);
    pending = {};
  }
  if (pools.size() < 2) return no_fit();
  pools.back().found += pending.found;
  pools.back().expected += pending.expected;
  Goodness result;
  for (const Pool& pool : pools) {
    const double off = pool.found - pool.expected;
    result.statistic += off * off / pool.expected;
  }
  result.freedom = static_cast<double>(pools.size() - 1);
  result.p = chi_square_upper(result.statistic, result.freedom);
  return result;
}

}  // namespace carlo
