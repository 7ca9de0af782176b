#pragma once

#include <span>

namespace carlo {

/// How well counts fit what is expected: Pearson's chi-square.
struct Goodness {
  double statistic = 0, freedom = 0;
  double p = 0;  ///< P(chi-square at least this large); tiny: they do not fit
};

/// They do not fit at all.
Goodness no_fit();

/// Counts in cells against the expected ones. Neighbouring cells are pooled until 100 are expected
/// in each; with fewer than two pools, no_fit().
Goodness pooled_goodness(std::span<const double> counts, std::span<const double> expected);

}  // namespace carlo
