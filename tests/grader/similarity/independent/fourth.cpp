#include "integration.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

// A right solution of lab 1, for similarity_test.sh: numbers are collected in vectors first.

using std::int64_t;
using Numbers = std::vector<double>;

namespace {

double total(const Numbers& numbers) {
  double all = 0;
  for (double number : numbers)
    all += number;
  return all;
}

Numbers uniforms(int64_t n, carlo::Rng& rng) {
  Numbers numbers(static_cast<size_t>(n));
  std::generate(numbers.begin(), numbers.end(), [&rng] { return rng.uniform(); });
  return numbers;
}

Numbers grid(double a, double b, int64_t n, double shift, int64_t count) {
  Numbers places;
  for (int64_t i = 0; i < count; ++i)
    places.emplace_back(a + (b - a) / static_cast<double>(n) * (static_cast<double>(i) + shift));
  return places;
}

Numbers values(const lab01::Function& f, Numbers places) {
  std::transform(places.begin(), places.end(), places.begin(), f);
  return places;
}

struct Places {
  Places(const lab01::Box& where, carlo::Rng& source) : box(where), rng(source) {
    for (size_t i = 0; i < box.lower.size(); ++i)
      volume *= side(i);
  }
  double side(size_t i) const { return box.upper[i] - box.lower[i]; }
  Numbers next() {
    Numbers place(box.lower.begin(), box.lower.end());
    for (size_t i = 0; i < place.size(); ++i)
      place[i] += side(i) * rng.uniform();
    return place;
  }
  const lab01::Box& box;
  carlo::Rng& rng;
  double volume = 1;
};

}  // namespace

namespace lab01 {

double average(const Function& f, int64_t n, carlo::Rng& rng) {
  return integrate(f, 0, 1, n, rng);
}

double integrate(const Function& f, double a, double b, int64_t n, carlo::Rng& rng) {
  Numbers places = uniforms(n, rng);
  for (double& place : places)
    place = a * (1 - place) + b * place;
  return (b - a) * total(values(f, std::move(places))) / static_cast<double>(n);
}

void Moments::add(double x) {
  const double weight = 1 / static_cast<double>(++n_);
  const double residual = x - mean_;
  m2_ += (1 - weight) * residual * residual;
  mean_ += weight * residual;
}

void Moments::merge(const Moments& other) {
  const double sum = static_cast<double>(n_ + other.n_);
  if (sum == 0) return;
  const double p = static_cast<double>(n_) / sum, q = static_cast<double>(other.n_) / sum;
  m2_ = m2_ + other.m2_ + sum * p * q * (mean_ - other.mean_) * (mean_ - other.mean_);
  mean_ += q * (other.mean_ - mean_);
  n_ += other.n_;
}

double Moments::variance() const {
  return m2_ / static_cast<double>(std::max<int64_t>(n_ - 1, 1));
}

double Moments::standard_error() const {
  return std::sqrt(variance() / static_cast<double>(std::max<int64_t>(n_, 1)));
}

double midpoint(const Function& f, double a, double b, int64_t n) {
  return total(values(f, grid(a, b, n, 0.5, n))) * (b - a) / static_cast<double>(n);
}

double trapezoid(const Function& f, double a, double b, int64_t n) {
  Numbers heights = values(f, grid(a, b, n, 0, n + 1));
  heights.front() /= 2;
  heights.back() /= 2;
  return total(heights) * (b - a) / static_cast<double>(n);
}

double simpson(const Function& f, double a, double b, int64_t n) {
  return trapezoid(f, a, b, n) / 3 + midpoint(f, a, b, n) * 2 / 3;
}

double nested_midpoint(const FunctionNd& f, const Box& box, int64_t n) {
  std::vector<Numbers> points{{}};
  double cell = 1;
  for (size_t i = 0; i < box.lower.size(); ++i) {
    std::vector<Numbers> longer;
    for (const Numbers& point : points) {
      for (double x : grid(box.lower[i], box.upper[i], n, 0.5, n)) {
        longer.push_back(point);
        longer.back().push_back(x);
      }
    }
    points.swap(longer);
    cell *= (box.upper[i] - box.lower[i]) / static_cast<double>(n);
  }
  double all = 0;
  for (const Numbers& point : points)
    all += f(point);
  return all * cell;
}

double integrate_box(const FunctionNd& f, const Box& box, int64_t n, carlo::Rng& rng) {
  Places places(box, rng);
  Numbers heights(static_cast<size_t>(n));
  std::generate(heights.begin(), heights.end(), [&] { return f(places.next()); });
  return places.volume * total(heights) / static_cast<double>(n);
}

Estimate integrate_domain(const FunctionNd& f, const Inside& inside, const Box& box, int64_t n,
                          carlo::Rng& rng) {
  Places places(box, rng);
  Moments hits;
  while (hits.count() < n) {
    const Numbers place = places.next();
    hits.add(inside(place) ? places.volume * f(place) : 0);
  }
  return {hits.mean(), hits.standard_error()};
}

}  // namespace lab01
