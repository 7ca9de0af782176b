#pragma once

#include "stats/goodness.h"

#include <cstdint>
#include <functional>
#include <span>

namespace lab05 {

using carlo::Goodness;

/// `counts` of n samples against each cell's probability. Neighbouring cells are pooled until 100
/// samples are expected in each. Samples that fell outside all cells, or into one of probability 0,
/// make p = 0.
Goodness goodness(std::span<const std::int64_t> counts, std::span<const double> probabilities,
                  std::int64_t n);

/// The integral of a density over [a, b) by Gauss's rule in eight pieces, never at the ends.
double integral_over_cell(const std::function<double(double)>& pdf, double a, double b);

}  // namespace lab05
