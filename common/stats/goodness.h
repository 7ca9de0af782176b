#pragma once

#include <span>

namespace carlo {

/// How well counts fit their expectation: Pearson's chi-square.
struct Goodness {
  double statistic = 0, freedom = 0;
  double p = 0;  ///< P(chi-square at least this large); tiny: a poor fit
};

/// Returns the result for counts that do not fit at all.
Goodness no_fit();

/// Compares counts in cells with their expectations. Neighbouring cells are pooled until 100 are
/// expected in each; with fewer than two pools, returns no_fit().
Goodness pooled_goodness(std::span<const double> counts, std::span<const double> expected);

}  // namespace carlo
