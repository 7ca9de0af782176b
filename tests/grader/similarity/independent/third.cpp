#include "integration.h"

#include <cmath>
#include <functional>
#include <vector>

// A right solution of lab 1, for similarity_test.sh: one function adds up, the others say what.

namespace lab01 {

using Term = std::function<double(std::int64_t)>;

static double sum_over(std::int64_t from, std::int64_t to, const Term& term) {
  double result = 0;
  for (auto i = from; i < to; ++i) {
    result += term(i);
  }
  return result;
}

static double width(const Box& box, std::size_t i) {
  return box.upper[i] - box.lower[i];
}

static double volume(const Box& box, std::size_t i = 0) {
  return i == box.lower.size() ? 1 : width(box, i) * volume(box, i + 1);
}

static void move_to(std::vector<double>& p, const Box& box, const std::function<double()>& u) {
  std::size_t i = 0;
  for (double& coordinate : p) {
    coordinate = u() * width(box, i) + box.lower[i];
    i++;
  }
}

double average(const Function& f, std::int64_t n, carlo::Rng& rng) {
  return sum_over(0, n, [&](std::int64_t) { return f(rng.uniform()); }) / n;
}

double integrate(const Function& f, double a, double b, std::int64_t n, carlo::Rng& rng) {
  const double sum = sum_over(0, n, [&](auto) { return f(rng.uniform() * (b - a) + a); });
  return sum / n * (b - a);
}

void Moments::add(double x) {
  Moments single;
  single.n_ = 1;
  single.mean_ = x;
  merge(single);
}

void Moments::merge(const Moments& other) {
  const auto together = n_ + other.n_;
  if (together == 0) return;
  const auto w = static_cast<double>(other.n_) / together;
  const auto delta = other.mean_ - mean_;
  m2_ += other.m2_ + w * n_ * std::pow(delta, 2);
  mean_ = other.n_ == together ? other.mean_ : mean_ + w * delta;
  n_ = together;
}

double Moments::variance() const {
  switch (n_) {
    case 0:
    case 1:
      return 0;
    default:
      return m2_ / (n_ - 1);
  }
}

double Moments::standard_error() const {
  return n_ == 0 ? 0 : std::sqrt(variance() / n_);
}

double midpoint(const Function& f, double a, double b, std::int64_t n) {
  const auto at = [&](std::int64_t i) { return f(a + (b - a) * (i + 0.5) / n); };
  return (b - a) / n * sum_over(0, n, at);
}

double trapezoid(const Function& f, double a, double b, std::int64_t n) {
  const auto at = [&](std::int64_t i) { return f(a + (b - a) * i / n); };
  return (b - a) / n * (sum_over(1, n, at) + (at(0) + at(n)) / 2);
}

double simpson(const Function& f, double a, double b, std::int64_t n) {
  const auto at = [&](double i) { return f(a + (b - a) * i / n); };
  const auto panel = [&](std::int64_t i) { return 4 * at(i + 0.5) + 2 * at(i + 1.0); };
  return (b - a) / (6.0 * n) * (sum_over(0, n - 1, panel) + at(0) + 4 * at(n - 0.5) + at(n));
}

double nested_midpoint(const FunctionNd& f, const Box& box, std::int64_t n) {
  std::vector<double> p;
  std::function<double()> inner;
  inner = [&] {
    const auto i = p.size();
    if (i == box.lower.size()) return f(p);
    return width(box, i) / n * sum_over(0, n, [&](std::int64_t k) {
             p.push_back(box.lower[i] + (k + 0.5) * width(box, i) / n);
             const double value = inner();
             p.pop_back();
             return value;
           });
  };
  return inner();
}

double integrate_box(const FunctionNd& f, const Box& box, std::int64_t n, carlo::Rng& rng) {
  std::vector<double> p(box.lower.size());
  const double sum = sum_over(0, n, [&](auto) {
    move_to(p, box, [&] { return rng.uniform(); });
    return f(p);
  });
  return sum * volume(box) / n;
}

Estimate integrate_domain(const FunctionNd& f, const Inside& inside, const Box& box, std::int64_t n,
                          carlo::Rng& rng) {
  const auto v = volume(box);
  std::vector<double> p(box.lower.size());
  Moments seen;
  sum_over(0, n, [&](auto) {
    move_to(p, box, [&] { return rng.uniform(); });
    seen.add(inside(p) ? v * f(p) : 0.0);
    return 0.0;
  });
  return {.value = seen.mean(), .standard_error = seen.standard_error()};
}

}  // namespace lab01
