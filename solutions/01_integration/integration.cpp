#include "integration.h"

#include <cmath>
#include <cstddef>
#include <vector>

// Lab 01: integration, solved.

namespace lab01 {

// Lab 1.1 -----------------------------------------------------------------------------------------

double average(const Function& f, std::int64_t n, carlo::Rng& rng) {
  double sum = 0;
  for (std::int64_t i = 0; i < n; ++i)
    sum += f(rng.uniform());
  return sum / static_cast<double>(n);
}

// Lab 1.2 -----------------------------------------------------------------------------------------

double integrate(const Function& f, double a, double b, std::int64_t n, carlo::Rng& rng) {
  const auto g = [&](double u) { return f(a + (b - a) * u); };
  return (b - a) * average(g, n, rng);
}

// Lab 1.3 -----------------------------------------------------------------------------------------

// Welford, "Note on a method for calculating corrected sums of squares and products", 1962.
void Moments::add(double x) {
  ++n_;
  const double from_old_mean = x - mean_;
  mean_ += from_old_mean / static_cast<double>(n_);
  m2_ += from_old_mean * (x - mean_);
}

// Chan, Golub, LeVeque, "Updating formulae and a pairwise algorithm for computing sample
// variances", 1979.
void Moments::merge(const Moments& other) {
  if (other.n_ == 0) return;
  const auto ours = static_cast<double>(n_);
  const auto theirs = static_cast<double>(other.n_);
  const double share = theirs / (ours + theirs);
  const double distance = other.mean_ - mean_;
  m2_ += other.m2_ + distance * distance * ours * share;
  mean_ += distance * share;
  n_ += other.n_;
}

double Moments::variance() const {
  return n_ < 2 ? 0 : m2_ / static_cast<double>(n_ - 1);
}

double Moments::standard_error() const {
  return n_ < 2 ? 0 : std::sqrt(variance() / static_cast<double>(n_));
}

// Lab 1.4 -----------------------------------------------------------------------------------------

double midpoint(const Function& f, double a, double b, std::int64_t n) {
  const double h = (b - a) / static_cast<double>(n);
  double sum = 0;
  for (std::int64_t i = 0; i < n; ++i)
    sum += f(a + (static_cast<double>(i) + 0.5) * h);
  return h * sum;
}

double trapezoid(const Function& f, double a, double b, std::int64_t n) {
  const double h = (b - a) / static_cast<double>(n);
  double sum = (f(a) + f(b)) / 2;
  for (std::int64_t i = 1; i < n; ++i)
    sum += f(a + static_cast<double>(i) * h);
  return h * sum;
}

// On each cell the rule is (2 midpoint + trapezoid) / 3: their leading errors cancel.
double simpson(const Function& f, double a, double b, std::int64_t n) {
  return (2 * midpoint(f, a, b, n) + trapezoid(f, a, b, n)) / 3;
}

// Lab 1.5 -----------------------------------------------------------------------------------------

namespace {

/// The integral over the dimensions `dim`, `dim` + 1, ..., with the coordinates before them held:
/// one application of the 1-D rule, whose integrand is the integral over the remaining dimensions.
double integral_from(std::size_t dim, std::vector<double>& x, const FunctionNd& f, const Box& box,
                     std::int64_t n) {
  if (dim == x.size()) return f(x);
  const auto slice = [&](double coordinate) {
    x[dim] = coordinate;
    return integral_from(dim + 1, x, f, box, n);
  };
  return midpoint(slice, box.lower[dim], box.upper[dim], n);
}

}  // namespace

double nested_midpoint(const FunctionNd& f, const Box& box, std::int64_t n) {
  std::vector<double> x(box.lower.size());
  return integral_from(0, x, f, box, n);
}

// Lab 1.6 -----------------------------------------------------------------------------------------

namespace {

void draw_point(const Box& box, std::vector<double>& x, carlo::Rng& rng) {
  for (std::size_t i = 0; i < x.size(); ++i) {
    x[i] = box.lower[i] + (box.upper[i] - box.lower[i]) * rng.uniform();
  }
}

double volume(const Box& box) {
  double product = 1;
  for (std::size_t i = 0; i < box.lower.size(); ++i)
    product *= box.upper[i] - box.lower[i];
  return product;
}

}  // namespace

double integrate_box(const FunctionNd& f, const Box& box, std::int64_t n, carlo::Rng& rng) {
  std::vector<double> x(box.lower.size());
  double sum = 0;
  for (std::int64_t i = 0; i < n; ++i) {
    draw_point(box, x, rng);
    sum += f(x);
  }
  return volume(box) * (sum / static_cast<double>(n));
}

// Lab 1.7 -----------------------------------------------------------------------------------------

Estimate integrate_domain(const FunctionNd& f, const Inside& inside, const Box& box, std::int64_t n,
                          carlo::Rng& rng) {
  std::vector<double> x(box.lower.size());
  Moments contributions;
  for (std::int64_t i = 0; i < n; ++i) {
    draw_point(box, x, rng);
    contributions.add(inside(x) ? f(x) : 0);
  }
  return {volume(box) * contributions.mean(), volume(box) * contributions.standard_error()};
}

}  // namespace lab01
