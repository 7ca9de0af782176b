#pragma once

#include "course/verdict/verdict.h"

namespace carlo::grader {

constexpr double claimed_power = .999;

/// A mean of `count` values of standard deviation `sd` that is `off` from the expected one:
/// 8.74 sd / sqrt(count) is caught. `variance` is that of the values.
Effect effect_on_mean(double off, double sd, double count, double variance);

/// A variance that is `ratio` times the expected one, tested by chi-square with `freedom` degrees
/// of freedom; as a part of the expected variance. Values of the same excess kurtosis are assumed.
Effect effect_on_variance(double ratio, double freedom);

/// The largest distance of `count` values' distribution from the expected one. The resolution is an
/// upper bound: one place where the distributions differ that much is enough to be caught.
Effect effect_on_distribution(double distance, double count);

/// Shares of cells that differ from the expected ones p by d, tested by chi-square over `count`
/// samples: the root of the sum of d^2 / p, which is the root mean square of the cells' relative
/// errors, each weighted by its share. Chance adds `freedom` to the statistic, which is taken off.
Effect effect_on_cells(double statistic, double freedom, double count);

}  // namespace carlo::grader
