#include "inversion_rejection.h"

#include "bins.h"
#include "support/error.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

// Lab 05: inversion and rejection, solved.

namespace lab05 {

// Lab 5.1 -----------------------------------------------------------------------------------------

double sample_exponential(double u, double rate) {
  return -std::log1p(-u) / rate;
}

double exponential_pdf(double x, double rate) {
  return x < 0 ? 0 : rate * std::exp(-rate * x);
}

// Lab 5.2 -----------------------------------------------------------------------------------------

// The root of f0 x + (f1 - f0) x^2 / 2 = u (f0 + f1) / 2, with a sum in the denominator: for nearly
// equal ends a difference would cancel.
double sample_linear(double u, double f0, double f1) {
  if (u == 0) return 0;
  const double height = std::hypot(std::sqrt(1 - u) * f0, std::sqrt(u) * f1);  // of the line at x
  return std::min(u * (f0 + f1) / (f0 + height), 1.0);
}

double linear_pdf(double x, double f0, double f1) {
  return x < 0 || x > 1 ? 0 : 2 * ((1 - x) * f0 + x * f1) / (f0 + f1);
}

double sample_tent(double u, double radius) {
  if (u < 0.5) return radius * (std::sqrt(2 * u) - 1);
  return radius * (1 - std::sqrt(2 * (1 - u)));
}

double tent_pdf(double x, double radius) {
  return std::max(1 - std::abs(x) / radius, 0.0) / radius;
}

// Lab 5.3 -----------------------------------------------------------------------------------------

double sample_power(double u, double n) {
  return std::pow(u, 1 / (n + 1));
}

double power_pdf(double x, double n) {
  return x < 0 || x > 1 ? 0 : (n + 1) * std::pow(x, n);
}

// Lab 5.4 -----------------------------------------------------------------------------------------

Discrete::Discrete(std::span<const double> weights) : cdf_(weights.begin(), weights.end()) {
  double sum = 0;
  for (double& entry : cdf_) {
    if (!(entry >= 0)) throw carlo::Error("weights must be >= 0, got {}", entry);
    entry = sum += entry;
  }
  if (!(sum > 0 && std::isfinite(sum))) {
    throw carlo::Error("the sum of the weights must be finite and > 0, got {}", sum);
  }
  // Divides, since 1 / sum may be infinite. From the last weight > 0 on the result is exactly 1.
  for (double& entry : cdf_)
    entry /= sum;
}

Discrete::Pick Discrete::sample(double u) const {
  const auto above = std::upper_bound(cdf_.begin(), cdf_.end(), u);
  const auto index = static_cast<std::size_t>(above - cdf_.begin());
  const double before = index == 0 ? 0 : cdf_[index - 1];
  const double fraction = (u - before) / (*above - before);
  return {index, std::min(fraction, std::nextafter(1.0, 0.0))};
}

double Discrete::probability(std::size_t index) const {
  return index == 0 ? cdf_[0] : cdf_[index] - cdf_[index - 1];
}

// Lab 5.5 -----------------------------------------------------------------------------------------

Tabulated1d::Tabulated1d(std::span<const double> weights) : bins_(weights) {}

double Tabulated1d::sample(double u) const {
  const auto [bin, fraction] = bins_.sample(u);
  return place_in_bin(bin, fraction, size());
}

double Tabulated1d::pdf(double x) const {
  if (!(x >= 0 && x < 1)) return 0;
  return bins_.probability(bin_of(x, size())) * static_cast<double>(size());
}

// Lab 5.6 -----------------------------------------------------------------------------------------

Tabulated2d::Tabulated2d(std::span<const double> weights, std::size_t width, std::size_t height)
    : columns_(height) {
  if (weights.size() != width * height) {
    throw carlo::Error("{} x {} cells need as many weights, got {}", width, height, weights.size());
  }
  std::vector<double> sums(height);
  for (std::size_t j = 0; j < height; ++j) {
    const auto row = weights.subspan(j * width, width);
    if (std::all_of(row.begin(), row.end(), [](double weight) { return weight == 0; })) continue;
    columns_[j] = Discrete(row);
    sums[j] = std::accumulate(row.begin(), row.end(), 0.0);
  }
  rows_ = Discrete(sums);
}

Point Tabulated2d::sample(double u_row, double u_column) const {
  const auto [j, down] = rows_.sample(u_row);
  const auto [i, across] = columns_[j].sample(u_column);
  return {place_in_bin(i, across, columns_[j].size()), place_in_bin(j, down, rows())};
}

double Tabulated2d::pdf(Point p) const {
  if (!(p.x >= 0 && p.x < 1 && p.y >= 0 && p.y < 1)) return 0;
  const std::size_t j = bin_of(p.y, rows());
  if (columns_[j].size() == 0) return 0;
  const std::size_t width = columns_[j].size();
  const double probability = rows_.probability(j) * columns_[j].probability(bin_of(p.x, width));
  return probability * static_cast<double>(width) * static_cast<double>(rows());
}

// Lab 5.7 -----------------------------------------------------------------------------------------

Accepted<double> sample_by_rejection(const Function& f, double a, double b, double f_max,
                                     carlo::Rng& rng) {
  for (std::int64_t darts = 1; darts <= max_darts; ++darts) {
    const double x = a + (b - a) * rng.uniform();
    const double y = f_max * rng.uniform();
    const double height = f(x);
    if (!(height >= 0 && height <= f_max)) {
      throw carlo::Error("f({}) must lie in [0, {}], got {}", x, f_max, height);
    }
    if (y < height) return {x, darts};
  }
  throw carlo::Error("{} darts, and none below f", max_darts);
}

double acceptance_rate(double integral, double a, double b, double f_max) {
  return integral / ((b - a) * f_max);
}

// Lab 5.8 -----------------------------------------------------------------------------------------

Accepted<Point> disc_by_rejection(carlo::Rng& rng) {
  for (std::int64_t darts = 1;; ++darts) {
    const double x = 2 * rng.uniform() - 1;
    const double y = 2 * rng.uniform() - 1;
    if (x * x + y * y <= 1) return {{x, y}, darts};
  }
}

Point disc_by_inversion(double u_radius, double u_angle) {
  const double radius = std::sqrt(u_radius);
  const double angle = 2 * std::numbers::pi * u_angle;
  return {radius * std::cos(angle), radius * std::sin(angle)};
}

double disc_pdf(Point p) {
  return p.x * p.x + p.y * p.y <= 1 ? 1 / std::numbers::pi : 0;
}

}  // namespace lab05
