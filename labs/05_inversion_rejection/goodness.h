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

/// Seconds that one call of `draw` takes, from `count` calls; the best of three rounds. The sum of
/// what it returns is kept, so that no compiler leaves the calls out.
double seconds_a_draw(std::int64_t count, const std::function<double()>& round);

}  // namespace lab05
