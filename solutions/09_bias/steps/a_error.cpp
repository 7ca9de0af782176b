#include "bias.h"

#include <cmath>
#include <limits>

// Lab 09, step a: separates bias and noise. Solved.

namespace lab09 {

// Lab 9.1 -----------------------------------------------------------------------------------------

ErrorParts split_error(std::span<const double> estimates, double exact) {
  const auto n = static_cast<double>(estimates.size());
  double sum = 0;
  for (const double x : estimates)
    sum += x - exact;
  const double off = sum / n;  // of the mean
  double squares = 0;
  for (const double x : estimates) {
    const double d = (x - exact) - off;
    squares += d * d;
  }
  const double variance = squares / (n - 1);
  return {off * off - variance / n, variance};
}

double fitted_slope(std::span<const double> n, std::span<const double> error) {
  const auto points = static_cast<double>(n.size());
  double mean_x = 0, mean_y = 0;
  for (std::size_t i = 0; i < n.size(); ++i) {
    mean_x += std::log(n[i]) / points;
    mean_y += std::log(error[i]) / points;
  }
  double xx = 0, xy = 0;
  for (std::size_t i = 0; i < n.size(); ++i) {
    const double dx = std::log(n[i]) - mean_x;
    xx += dx * dx;
    xy += dx * (std::log(error[i]) - mean_y);
  }
  return xy / xx;
}

double overtakes_after(double a, double b, double bias2) {
  if (a <= b) return 0;
  if (bias2 <= 0) return std::numeric_limits<double>::infinity();
  return (a - b) / bias2;
}

}  // namespace lab09
