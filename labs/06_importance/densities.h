#pragma once

#include <algorithm>
#include <functional>

// Given to you: a density as two functions, and the densities that the lab's experiments use. How
// they are made is lab 05's business.

namespace lab06 {

using Function = std::function<double(double)>;

/// A probability density on the line, with its way to draw from it. The two belong together: for
/// uniform u in [0, 1), sample(u) has the density pdf.
struct Density {
  Function sample;  ///< takes any u in [0, 1), never 1
  Function pdf;     ///< per unit of x; 0 outside the support
};

/// The x that is nearest to `x` among the doubles below 1. A quotient that is below 1 on paper may
/// be rounded to 1, which is no number to draw with.
inline double below_one(double x) {
  return std::min(x, 0x1.fffffffffffffp-1);
}

/// Uniform on [a, b), a < b.
Density uniform_density(double a, double b);

/// Proportional to x^n on [0, 1], n >= 0; n = 0 is uniform. With x a cosine, a glossy lobe.
Density power_density(double n);

/// Proportional to exp(-rate (x - from)) for x >= from; rate > 0. Free paths in fog.
Density exponential_density(double rate, double from = 0);

/// A bump around `centre`: the logistic density, e / (scale (1 + e)^2) with
/// e = exp(-|x - centre| / scale); scale > 0.
Density logistic_density(double centre, double scale);
/// Its integral from minus infinity to x.
double logistic_cdf(double x, double centre, double scale);

}  // namespace lab06
