#include "integration.h"

#include <cmath>
#include <numeric>
#include <vector>

// A right solution of lab 1, for similarity_test.sh: integrals go through averages, points are made
// anew.

namespace lab01 {
namespace {

/// One uniform point of the box.
std::vector<double> sample(const Box& box, carlo::Rng& rng) {
  std::vector<double> point;
  point.reserve(box.lower.size());
  for (std::size_t axis = 0; axis != box.lower.size(); ++axis)
    point.push_back(std::lerp(box.lower[axis], box.upper[axis], rng.uniform()));
  return point;
}

double size_of(const Box& box) {
  return std::inner_product(box.lower.begin(), box.lower.end(), box.upper.begin(), 1.0,
                            std::multiplies<>(), [](double lo, double hi) { return hi - lo; });
}

}  // namespace

double average(const Function& f, std::int64_t n, carlo::Rng& rng) {
  Moments values;
  while (values.count() < n)
    values.add(f(rng.uniform()));
  return values.mean();
}

double integrate(const Function& f, double a, double b, std::int64_t n, carlo::Rng& rng) {
  Moments values;
  while (values.count() < n)
    values.add(f(std::lerp(a, b, rng.uniform())));
  return values.mean() * (b - a);
}

void Moments::add(double x) {
  const Moments before = *this;
  n_ = before.n_ + 1;
  mean_ = before.mean_ + (x - before.mean_) / double(n_);
  m2_ = before.m2_ + (x - before.mean_) * (x - mean_);
}

void Moments::merge(const Moments& other) {
  if (other.count() > 0) {
    const double all = double(n_ + other.n_), gap = other.mean_ - mean_;
    m2_ = m2_ + other.m2_ + gap * gap * double(n_) * double(other.n_) / all;
    mean_ = mean_ + gap * double(other.n_) / all;
    n_ = n_ + other.n_;
  }
}

double Moments::variance() const {
  if (count() <= 1) return 0.0;
  return m2_ / double(count() - 1);
}

double Moments::standard_error() const {
  if (count() <= 1) return 0.0;
  return std::sqrt(m2_ / (double(count()) * double(count() - 1)));
}

double midpoint(const Function& f, double a, double b, std::int64_t n) {
  double total = 0;
  for (std::int64_t cell = 0; cell != n; ++cell)
    total += f(std::lerp(a, b, (2 * double(cell) + 1) / (2 * double(n))));
  return total * (b - a) / double(n);
}

double trapezoid(const Function& f, double a, double b, std::int64_t n) {
  double total = 0;
  for (std::int64_t joint = 0; joint <= n; ++joint) {
    const bool at_end = joint == 0 || joint == n;
    total += (at_end ? 0.5 : 1.0) * f(std::lerp(a, b, double(joint) / double(n)));
  }
  return total * (b - a) / double(n);
}

double simpson(const Function& f, double a, double b, std::int64_t n) {
  const double centres = midpoint(f, a, b, n), joints = trapezoid(f, a, b, n);
  return centres + (joints - centres) / 3;
}

double nested_midpoint(const FunctionNd& f, const Box& box, std::int64_t n) {
  const std::size_t d = box.lower.size();
  std::vector<std::int64_t> cell(d, 0);
  std::vector<double> point(d);
  double total = 0;
  for (std::size_t axis = 0; axis < d;) {
    for (std::size_t k = 0; k < d; ++k)
      point[k] = std::lerp(box.lower[k], box.upper[k], (double(cell[k]) + 0.5) / double(n));
    total += f(point);
    for (axis = 0; axis < d && ++cell[axis] == n; ++axis)
      cell[axis] = 0;
  }
  return total * size_of(box) / std::pow(double(n), double(d));
}

double integrate_box(const FunctionNd& f, const Box& box, std::int64_t n, carlo::Rng& rng) {
  Moments values;
  while (values.count() < n)
    values.add(f(sample(box, rng)));
  return values.mean() * size_of(box);
}

Estimate integrate_domain(const FunctionNd& f, const Inside& inside, const Box& box, std::int64_t n,
                          carlo::Rng& rng) {
  Moments values;
  while (values.count() < n) {
    const std::vector<double> point = sample(box, rng);
    if (inside(point)) {
      values.add(f(point));
    } else {
      values.add(0);
    }
  }
  return Estimate{values.mean() * size_of(box), values.standard_error() * size_of(box)};
}

}  // namespace lab01
