#include "renderer/bench/spread.h"

#include <algorithm>

namespace bench {

Spread spread(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return {values[values.size() / 2], values.front(), values.back()};
}

}  // namespace bench
