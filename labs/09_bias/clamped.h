#pragma once

#include "bias.h"

#include <algorithm>
#include <cmath>

namespace lab09 {

/// An estimate with a fat tail: 1/distance^2 from a point over the middle of a disc of radius 1 to
/// points of the disc that are uniform by area. With u uniform, distance^2 = u + height2.
struct Glow {
  double height2;

  double sample(double u) const { return 1 / (u + height2); }
  double largest() const { return 1 / height2; }
  /// The integral of sample(u) over [0, 1).
  double exact() const { return std::log1p(1 / height2); }

  /// Both parts of the square error of the mean of n samples that are clamped to c: samples are
  /// above c for u below `cut`.
  ErrorParts parts(double c, double n) const {
    const double cut = std::clamp(1 / c - height2, 0.0, 1.0);
    const double mean = c * cut + std::log((1 + height2) / (cut + height2));
    const double squares = c * c * cut + 1 / (cut + height2) - 1 / (1 + height2);
    const double bias = mean - exact();
    return {bias * bias, (squares - mean * mean) / n};
  }

  /// The c with the least square error for n samples.
  double best_clamp(double n) const {
    // Ternary search on log c, where the error has one valley.
    double low = 0, high = std::log(largest());
    const auto error = [&](double x) {
      const ErrorParts p = parts(std::exp(x), n);
      return p.bias2 + p.variance;
    };
    for (int i = 0; i < 100; ++i) {
      const double a = low + (high - low) / 3, b = high - (high - low) / 3;
      (error(a) < error(b) ? high : low) = error(a) < error(b) ? b : a;
    }
    return std::exp((low + high) / 2);
  }
};

}  // namespace lab09
