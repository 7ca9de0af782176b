#include "stats/fit.h"

#include "support/error.h"

#include <cmath>
#include <limits>
#include <numbers>

namespace carlo {
namespace {

bool positive(double value) {
  return std::isfinite(value) && value > 0;
}

void check_input(std::span<const double> x, std::span<const double> y,
                 std::span<const double> weights, double confidence) {
  if (x.size() != y.size()) throw Error("a fit got {} x and {} y", x.size(), y.size());
  if (!weights.empty() && weights.size() != x.size()) {
    throw Error("a fit got {} points and {} weights", x.size(), weights.size());
  }
  if (x.size() < 3) throw Error("a fit needs at least 3 points, got {}", x.size());
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (!positive(x[i]) || !positive(y[i])) {
      throw Error("a power law needs finite x > 0 and y > 0, got ({}, {})", x[i], y[i]);
    }
  }
  for (const double w : weights) {
    if (!positive(w)) throw Error("weights of a fit must be finite and > 0, got {}", w);
  }
  if (!(confidence > 0 && confidence < 1)) {
    throw Error("a confidence must lie between 0 and 1, got {}", confidence);
  }
}

/// P(|T| <= t) where t = sqrt(freedom) tan(angle): a finite sum, since the degrees are whole.
double student_share(double angle, std::size_t freedom) {
  const double sine = std::sin(angle), cosine = std::cos(angle);
  const bool odd = freedom % 2 == 1;
  double term = odd ? sine * cosine : sine, sum = 0;
  for (std::size_t k = odd ? 3 : 2; k <= freedom; k += 2) {
    sum += term;
    const auto even_or_odd = static_cast<double>(k);
    term *= (even_or_odd - 1) / even_or_odd * cosine * cosine;
  }
  return odd ? 2 / std::numbers::pi * (angle + sum) : sum;
}

}  // namespace

double student_half_width(double confidence, std::size_t freedom) {
  double low = 0, high = std::numbers::pi / 2;
  for (;;) {
    const double middle = (low + high) / 2;
    if (middle <= low || middle >= high) break;
    (student_share(middle, freedom) < confidence ? low : high) = middle;
  }
  return std::sqrt(static_cast<double>(freedom)) * std::tan(low);
}

PowerFit fit_power_law(std::span<const double> x, std::span<const double> y,
                       std::span<const double> weights, double confidence) {
  check_input(x, y, weights, confidence);
  const std::size_t n = x.size();
  const auto weight = [&](std::size_t i) { return weights.empty() ? 1.0 : weights[i]; };

  double total = 0, mean_x = 0, mean_y = 0;
  for (std::size_t i = 0; i < n; ++i) {
    total += weight(i);
    mean_x += weight(i) * std::log(x[i]);
    mean_y += weight(i) * std::log(y[i]);
  }
  mean_x /= total;
  mean_y /= total;

  double sxx = 0, sxy = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const double dx = std::log(x[i]) - mean_x;
    sxx += weight(i) * dx * dx;
    sxy += weight(i) * dx * (std::log(y[i]) - mean_y);
  }
  // Rounding leaves a trace of spread even if all x are equal.
  constexpr double epsilon = std::numeric_limits<double>::epsilon();
  if (!(sxx > total * epsilon * epsilon * (1 + mean_x * mean_x))) {
    throw Error("a fit needs at least two different x, got {} times {}", n, x[0]);
  }
  const double slope = sxy / sxx;

  double residuals = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const double r = std::log(y[i]) - mean_y - slope * (std::log(x[i]) - mean_x);
    residuals += weight(i) * r * r;
  }
  const auto freedom = static_cast<double>(n - 2);
  const double t = student_half_width(confidence, n - 2);
  const double sigma = std::sqrt(residuals / freedom);

  PowerFit fit;
  fit.slope = slope;
  fit.slope_half_width = t * sigma / std::sqrt(sxx);
  fit.log_scale = mean_y - slope * mean_x;
  fit.confidence = confidence;
  fit.points = n;
  fit.mean_log_x = mean_x;
  fit.mean_half_width = t * sigma / std::sqrt(total);
  return fit;
}

}  // namespace carlo
