#pragma once

#include <algorithm>
#include <cmath>
#include <functional>

// Given to you: a density as two functions, and the densities used in the lab's experiments. Lab 05
// is about how to make them.

namespace lab06 {

using Function = std::function<double(double)>;

/// A probability density on the line, with a way to draw from it. The two belong together: for
/// uniform u in [0, 1), sample(u) has the density pdf.
// slide: density
struct Density {
  Function sample;  ///< takes any u in [0, 1), never 1
  Function pdf;     ///< per unit of x; 0 outside the support
};
// end slide

/// x, or the last double below 1 if x is not below 1. A quotient that is mathematically below 1 may
/// be rounded to 1, which is not a number to draw with.
inline double below_one(double x) {
  return std::min(x, 0x1.fffffffffffffp-1);
}

/// Uniform on [a, b), a < b.
inline Density uniform_density(double a, double b) {
  return {[=](double u) { return a + (b - a) * u; },
          [=](double x) { return x >= a && x < b ? 1 / (b - a) : 0; }};
}

/// Proportional to x^n on [0, 1], n >= 0; n = 0 is uniform. With x a cosine, a glossy lobe.
inline Density power_density(double n) {
  return {[=](double u) { return std::pow(u, 1 / (n + 1)); },
          [=](double x) { return x >= 0 && x <= 1 ? (n + 1) * std::pow(x, n) : 0; }};
}

/// Proportional to exp(-rate (x - from)) for x >= from; rate > 0. Free paths in fog.
inline Density exponential_density(double rate, double from = 0) {
  return {[=](double u) { return from - std::log1p(-u) / rate; },
          [=](double x) { return x >= from ? rate * std::exp(-rate * (x - from)) : 0; }};
}

/// A bump around `centre`: the logistic density, e / (scale (1 + e)^2) with
/// e = exp(-|x - centre| / scale); scale > 0.
inline Density logistic_density(double centre, double scale) {
  // u = 0 is infinitely far out; it is moved to where the density is almost 0.
  return {[=](double u) { return centre + scale * (u > 0 ? std::log(u / (1 - u)) : -700.0); },
          [=](double x) {
            const double e = std::exp(-std::abs(x - centre) / scale);
            return e / (scale * (1 + e) * (1 + e));
          }};
}

}  // namespace lab06
