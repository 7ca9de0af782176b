#pragma once

#include <cmath>
#include <cstddef>
#include <limits>
#include <span>

namespace carlo {

/// A power law y = scale x^slope fitted to points, with the uncertainty of the fit. Slopes have no
/// unit; x and y keep theirs.
struct PowerFit {
  double slope = 0;
  double slope_half_width = 0;  ///< the confidence interval is slope -+ this
  double log_scale = 0;         ///< natural logarithm of y at x = 1
  double confidence = 0;        ///< of the interval and the band, e.g. 0.95
  std::size_t points = 0;

  /// The fitted y at x > 0.
  double at(double x) const { return std::exp(log_scale + slope * std::log(x)); }
  /// The confidence band of the fitted line at x > 0: it runs from at(x) / factor to at(x) factor.
  double band_factor(double x) const {
    return std::exp(std::hypot(mean_half_width, slope_half_width * (std::log(x) - mean_log_x)));
  }

  // What the band is computed from.
  double mean_log_x = 0;       ///< weighted mean of log x
  double mean_half_width = 0;  ///< half width of the band at mean_log_x, in log y
};

/// Least squares of log y against log x. The interval is Student's t with points - 2 degrees of
/// freedom, so it is right when the errors of log y are independent, normal and of one size (or of
/// variance 1/weight up to one common factor). For points off a straight line by a systematic
/// curve it only says how straight they are.
/// x, y: finite and > 0, at least three points, at least two different x. weights: none (all
/// equal) or one a point, finite and > 0. 0 < confidence < 1. Throws Error otherwise.
/// Source: Draper and Smith, "Applied Regression Analysis", chapter 1.
PowerFit fit_power_law(std::span<const double> x, std::span<const double> y,
                       std::span<const double> weights = {}, double confidence = 0.95);

/// Where two power laws meet: the x at which both have the same y. Infinite when the slopes are
/// equal.
inline double crossing(const PowerFit& a, const PowerFit& b) {
  if (a.slope == b.slope) return std::numeric_limits<double>::infinity();
  return std::exp((b.log_scale - a.log_scale) / (a.slope - b.slope));
}

}  // namespace carlo
