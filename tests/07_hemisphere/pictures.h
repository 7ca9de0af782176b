#pragma once

#include "07_hemisphere/cosine_power.h"
#include "grader/judge/compare.h"
#include "grader/judge/figures.h"
#include "stats/distributions.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

// Figures for the student about wrong directions and densities.

namespace lab07_tests {

/// The angle between w and z, accurate for small ones.
inline double angle_to_axis(Double3 w) {
  return std::atan2(std::hypot(w.x, w.y), w.z);
}
inline double degrees(double radians) {
  return radians * 180 / pi;
}

/// The angle within which all but a ten-thousandth of the law lies; 90 degrees for wide ones.
inline double edge_of(const Share& share) {
  double low = 0, high = pi / 2;
  for (int i = 0; i < 60; ++i) {
    const double middle = (low + high) / 2;
    (share({std::sin(middle), 0, std::cos(middle)}) < 0.9999 ? low : high) = middle;
  }
  return high > 1.2 ? pi / 2 : high;
}

/// The number of directions at each angle to the axis, up to `last`.
inline carlo::grader::Figure angle_figure(const std::vector<Double3>& directions,
                                          const Share& share, double last) {
  constexpr std::size_t bins = 36;
  const auto within = [&](double angle) {
    return angle < pi / 2 ? share({std::sin(angle), 0, std::cos(angle)}) : 1;
  };
  std::vector<double> counts(bins), expected;
  for (const Double3 w : directions) {
    const auto bin = static_cast<std::size_t>(angle_to_axis(w) / last * bins);
    if (bin < bins) counts[bin] += 1;
  }
  for (std::size_t i = 0; i < bins; ++i) {
    const double step = last / bins, from = step * static_cast<double>(i);
    expected.push_back((within(from + step) - within(from)) *
                       static_cast<double>(directions.size()));
  }
  carlo::grader::Figure figure = carlo::grader::counts_figure(
      {"angle to the axis, in degrees", 0, degrees(last)}, counts, expected);
  figure.title = "Directions at each angle to the axis";
  return figure;
}

/// The number of directions at each azimuth.
inline carlo::grader::Figure azimuth_figure(const std::vector<Double3>& directions) {
  constexpr std::size_t bins = 36;
  std::vector<double> counts(bins);
  for (const Double3 w : directions)
    counts[std::min(static_cast<std::size_t>(azimuth_share(w) * bins), bins - 1)] += 1;
  const std::vector<double> expected(bins, static_cast<double>(directions.size()) / bins);
  carlo::grader::Figure figure =
      carlo::grader::counts_figure({"azimuth, in degrees", 0, 360}, counts, expected);
  figure.title = "Directions at each azimuth";
  return figure;
}

/// The simplest figure that shows what is wrong with counts in rows of one angle and columns of one
/// azimuth, all of the same mass: the angles alone, the azimuths alone, or the cells.
inline carlo::grader::Figure directions_figure(const std::vector<Double3>& directions,
                                               const Share& share,
                                               const std::vector<double>& counts) {
  constexpr std::size_t side = cells_a_side;
  const double share_of_one = static_cast<double>(directions.size()) / side;
  std::vector<double> angles(side), azimuths(side);
  for (std::size_t i = 0; i < counts.size(); ++i) {
    angles[i / side] += counts[i];
    azimuths[i % side] += counts[i];
  }
  const auto off = [&](const std::vector<double>& sums) {
    double statistic = 0;
    for (const double sum : sums)
      statistic += (sum - share_of_one) * (sum - share_of_one) / share_of_one;
    return !(carlo::chi_square_upper(statistic, side - 1) >= carlo::grader::comparison_alpha());
  };
  if (off(angles)) return angle_figure(directions, share, edge_of(share));
  if (off(azimuths)) return azimuth_figure(directions);
  return carlo::grader::cells_figure("azimuth, 0 to 360 degrees", "angle to the axis, from 0", side,
                                     counts,
                                     std::vector<double>(counts.size(), share_of_one / side));
}

}  // namespace lab07_tests
