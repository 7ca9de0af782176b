#pragma once

#include "course/verdict/verdict.h"

namespace carlo::grader {

constexpr double claimed_power = .999;

/// The effect on a mean of `count` values of standard deviation `sd` that is `off` from the
/// expected one: 8.74 sd / sqrt(count) is caught. `variance` is that of the values.
Effect effect_on_mean(double off, double sd, double count, double variance);

/// The effect on a variance that is `ratio` times the expected one, tested by chi-square with
/// `freedom` degrees of freedom; relative to the expected variance. Assumes values of the same
/// excess kurtosis.
Effect effect_on_variance(double ratio, double freedom);

/// The largest distance of the distribution of `count` values from the expected one. The resolution
/// is an upper bound: it suffices if the distributions differ that much at one place.
Effect effect_on_distribution(double distance, double count);

/// The effect on shares of cells that differ from the expected ones p by d, tested by chi-square
/// over `count` samples: the root of the sum of d^2 / p, which is the root mean square of the
/// cells' relative errors, each weighted by its share. Subtracts `freedom`, which chance adds to
/// the statistic.
Effect effect_on_cells(double statistic, double freedom, double count);

}  // namespace carlo::grader
