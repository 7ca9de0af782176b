#include "integration.h"

#include <cmath>
#include <vector>

// A right solution of lab 1, for similarity_test.sh: plain loops, everything written out in its
// place.

double lab01::average(const Function& f, std::int64_t n, carlo::Rng& rng) {
  double s = 0.0;
  std::int64_t k = n;
  while (k-- > 0) {
    double u = rng.uniform();
    s = s + f(u);
  }
  return s / (double)n;
}

double lab01::integrate(const Function& f, double a, double b, std::int64_t n, carlo::Rng& rng) {
  double width = b - a;
  double s = 0.0;
  std::int64_t k = n;
  while (k-- > 0) {
    double u = rng.uniform();
    double x = a + u * width;
    s = s + f(x);
  }
  return s * width / (double)n;
}

void lab01::Moments::add(double x) {
  double d = x - mean_;
  double count_before = (double)n_;
  n_ += 1;
  m2_ += d * d * count_before / (double)n_;
  mean_ += d / (double)n_;
}

void lab01::Moments::merge(const Moments& other) {
  if (n_ == 0) {
    *this = other;
    return;
  }
  double na = (double)n_;
  double nb = (double)other.n_;
  double d = other.mean_ - mean_;
  n_ = n_ + other.n_;
  mean_ += d * nb / (double)n_;
  m2_ += other.m2_;
  m2_ += d * d * (na * nb / (double)n_);
}

double lab01::Moments::variance() const {
  double v = 0;
  if (n_ > 1) {
    v = m2_ / (double)(n_ - 1);
  }
  return v;
}

double lab01::Moments::standard_error() const {
  double e = 0;
  if (n_ > 1) {
    e = sqrt(variance()) / sqrt((double)n_);
  }
  return e;
}

double lab01::midpoint(const Function& f, double a, double b, std::int64_t n) {
  double s = 0.0;
  double step = (b - a) / (double)n;
  for (std::int64_t k = 1; k <= n; k++) {
    double x = a + step * ((double)k - 0.5);
    s += f(x);
  }
  return s * step;
}

double lab01::trapezoid(const Function& f, double a, double b, std::int64_t n) {
  double step = (b - a) / (double)n;
  double ends = f(a) + f(b);
  double inner = 0.0;
  for (std::int64_t k = n - 1; k >= 1; k--) {
    inner += f(a + step * (double)k);
  }
  return step * (0.5 * ends + inner);
}

double lab01::simpson(const Function& f, double a, double b, std::int64_t n) {
  double step = (b - a) / (2.0 * (double)n);
  double s = f(a) + f(b);
  for (std::int64_t k = 1; k < 2 * n; k++) {
    double weight = k % 2 == 1 ? 4.0 : 2.0;
    s += weight * f(a + (double)k * step);
  }
  return s * step / 3.0;
}

double lab01::nested_midpoint(const FunctionNd& f, const Box& box, std::int64_t n) {
  int d = (int)box.lower.size();
  std::int64_t points = 1;
  double cell_volume = 1.0;
  for (int i = 0; i < d; i++) {
    points *= n;
    cell_volume *= (box.upper[i] - box.lower[i]) / (double)n;
  }
  double s = 0.0;
  std::vector<double> p(d);
  for (std::int64_t index = 0; index < points; index++) {
    std::int64_t rest = index;
    for (int i = d - 1; i >= 0; i--) {
      p[i] = box.lower[i] + ((double)(rest % n) + 0.5) * (box.upper[i] - box.lower[i]) / (double)n;
      rest /= n;
    }
    s += f(p);
  }
  return s * cell_volume;
}

double lab01::integrate_box(const FunctionNd& f, const Box& box, std::int64_t n, carlo::Rng& rng) {
  auto all = [](std::span<const double>) { return true; };
  return integrate_domain(f, all, box, n, rng).value;
}

lab01::Estimate lab01::integrate_domain(const FunctionNd& f, const Inside& inside, const Box& box,
                                        std::int64_t n, carlo::Rng& rng) {
  int d = (int)box.lower.size();
  double vol = 1.0;
  for (int i = 0; i < d; i++) {
    vol = vol * (box.upper[i] - box.lower[i]);
  }
  Moments m;
  std::vector<double> p(d);
  for (std::int64_t k = 0; k < n; k++) {
    for (int i = 0; i < d; i++) {
      double u = rng.uniform();
      p[i] = box.lower[i] * (1.0 - u) + box.upper[i] * u;
    }
    double y = 0.0;
    if (inside(p)) {
      y = vol * f(p);
    }
    m.add(y);
  }
  Estimate result;
  result.value = m.mean();
  result.standard_error = m.standard_error();
  return result;
}
