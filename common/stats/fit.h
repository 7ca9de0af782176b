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

  /// Returns the fitted y at x > 0.
  double at(double x) const { return std::exp(log_scale + slope * std::log(x)); }
  /// Returns the factor of the fitted line's confidence band at x > 0, from at(x) / factor to at(x)
  /// factor.
  double band_factor(double x) const {
    return std::exp(std::hypot(mean_half_width, slope_half_width * (std::log(x) - mean_log_x)));
  }

  // The parameters of the band.
  double mean_log_x = 0;       ///< weighted mean of log x
  double mean_half_width = 0;  ///< half width of the band at mean_log_x, in log y
};

/// Fits log y against log x by least squares. The interval is Student's t with points - 2 degrees
/// of freedom, which is right if the errors of log y are independent, normal and of equal variance
/// (or of variance 1/weight up to a common factor). For points that deviate systematically from a
/// straight line it only says how straight they are.
/// x, y: finite and > 0, at least three points, at least two different x. weights: none (all equal)
/// or one per point, finite and > 0. 0 < confidence < 1. Throws Error otherwise.
/// Source: Draper and Smith, "Applied Regression Analysis", chapter 1.
PowerFit fit_power_law(std::span<const double> x, std::span<const double> y,
                       std::span<const double> weights = {}, double confidence = 0.95);

/// Returns the t > 0 for which Student's T with `freedom` >= 1 degrees has P(|T| <= t) =
/// `confidence`, 0 < confidence < 1; that probability is right to 1e-13. Takes time in proportion
/// to `freedom`. Source: Abramowitz and Stegun, "Handbook of Mathematical Functions", 26.7.3
/// and 26.7.4.
double student_half_width(double confidence, std::size_t freedom);

/// Returns the x at which two power laws have the same y. Infinite if the slopes are equal.
inline double crossing(const PowerFit& a, const PowerFit& b) {
  if (a.slope == b.slope) return std::numeric_limits<double>::infinity();
  return std::exp((b.log_scale - a.log_scale) / (a.slope - b.slope));
}

}  // namespace carlo
