#include "importance.h"

#include "support/error.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

// Lab 06: importance sampling, solved.

namespace lab06 {

// Lab 6.1 -----------------------------------------------------------------------------------------

double contribution(const Function& f, const Density& p, double x) {
  const double pdf = p.pdf(x);
  if (!(pdf >= 0)) throw carlo::Error("the pdf at x = {} is {}, expected a number >= 0", x, pdf);
  return pdf > 0 ? f(x) / pdf : 0;
}

std::vector<double> contributions(const Function& f, const Density& p, std::int64_t n,
                                  carlo::Rng& rng) {
  std::vector<double> values(static_cast<std::size_t>(n));
  for (double& value : values)
    value = contribution(f, p, p.sample(rng.uniform()));
  return values;
}

// Lab 6.2 -----------------------------------------------------------------------------------------

// Sums differences from the first value, so that numbers that agree in many digits keep the others.
Estimate summarize(std::span<const double> values) {
  const auto n = static_cast<double>(values.size());
  const double origin = values[0];
  double sum = 0;
  for (const double value : values)
    sum += value - origin;
  const double mean = sum / n;
  if (values.size() < 2) return {origin, 0, 0};
  double squares = 0;
  for (const double value : values)
    squares += (value - origin - mean) * (value - origin - mean);
  const double variance = squares / (n - 1);
  return {origin + mean, variance, std::sqrt(variance / n)};
}

double efficiency(double variance, double seconds) {
  return 1 / (variance * seconds);
}

// Lab 6.3 -----------------------------------------------------------------------------------------

// Seen from the light source, equal angles receive equal light, so the angle is uniform. The angle
// between a and b, and the point at an angle from a, are computed with tangents of sums: a / height
// and b / height may both be so large that their angles round to the same number.
Density light_density(double height, double a, double b) {
  const double angle = std::atan2(height * (b - a), height * height + a * b);
  const auto sample = [=](double u) {
    const double s = std::sin(angle * u), c = std::cos(angle * u);
    const double ahead = height * c - a * s;
    return ahead > 0 ? std::clamp(height * ((a * c + height * s) / ahead), a, b) : b;
  };
  const auto pdf = [=](double t) {
    return t >= a && t <= b ? height / (angle * (height * height + t * t)) : 0;
  };
  return {sample, pdf};
}

// Lab 6.4 -----------------------------------------------------------------------------------------

double largest_share(std::span<const double> values) {
  double largest = 0;
  double sum = 0;
  for (const double value : values) {
    largest = std::max(largest, std::abs(value));
    sum += std::abs(value);
  }
  return sum > 0 ? largest / sum : 0;
}

double tail_index(std::span<const double> values, std::size_t k) {
  std::vector<double> sizes;
  for (const double value : values)
    sizes.push_back(std::abs(value));
  std::sort(sizes.begin(), sizes.end(), std::greater<>());
  if (sizes[k] == 0) return std::numeric_limits<double>::infinity();
  double logs = 0;
  for (std::size_t i = 0; i < k; ++i)
    logs += std::log(sizes[i] / sizes[k]);
  return static_cast<double>(k) / logs;
}

namespace {

/// A decision made by u, and u rescaled to [0, 1).
struct Choice {
  bool first;
  double u;
};

Choice choose(double u, double share) {
  if (u < share) return {true, below_one(u / share)};
  return {false, below_one((u - share) / (1 - share))};
}

}  // namespace

Density mixture(const Density& p, const Density& q, double share) {
  const auto sample = [=](double u) {
    const Choice choice = choose(u, share);
    return choice.first ? p.sample(choice.u) : q.sample(choice.u);
  };
  const auto pdf = [=](double x) { return share * p.pdf(x) + (1 - share) * q.pdf(x); };
  return {sample, pdf};
}

// Lab 6.5 -----------------------------------------------------------------------------------------

// A dart is kept with probability g(x) / g_max, so the kept x have the density g / ((b - a) g_max)
// per dart: it integrates to the probability of being kept, and the rest are zeros.
std::vector<double> rejection_contributions(const Function& f, const Function& g, double a,
                                            double b, double g_max, std::int64_t darts,
                                            carlo::Rng& rng) {
  std::vector<double> values(static_cast<std::size_t>(darts));
  for (double& value : values) {
    const double x = a + (b - a) * rng.uniform();
    const double y = g_max * rng.uniform();
    const double height = g(x);
    if (!(height >= 0 && height <= g_max)) {
      throw carlo::Error("g({}) is {}, expected a number from 0 to {}", x, height, g_max);
    }
    if (y < height) value = (b - a) * g_max * f(x) / height;
  }
  return values;
}

// Lab 6.6 -----------------------------------------------------------------------------------------

namespace {

/// The product of an effort as mantissa and exponent, since it may overflow or underflow a double.
struct Product {
  double mantissa;
  int exponent;
};

Product product_of(Effort effort) {
  Product product{};
  int exponent = 0;
  product.mantissa =
      std::frexp(effort.samples, &product.exponent) * std::frexp(effort.pdf, &exponent);
  product.exponent += exponent;
  return product;
}

/// 1 / (1 + r^power), where r is the other's product over own's: where that overflows the weight is
/// 0 anyway.
double share_of(Effort own, Effort other, int power) {
  if (!(own.samples > 0 && own.pdf > 0)) return 0;
  if (!(other.samples > 0 && other.pdf > 0) || std::isinf(own.pdf)) return 1;
  if (std::isinf(other.pdf)) return 0;
  const Product ours = product_of(own), theirs = product_of(other);
  const double ratio = std::ldexp(theirs.mantissa / ours.mantissa, theirs.exponent - ours.exponent);
  return 1 / (1 + (power == 1 ? ratio : ratio * ratio));
}

}  // namespace

double balance_weight(Effort own, Effort other) {
  return share_of(own, other, 1);
}

double power_weight(Effort own, Effort other) {
  return share_of(own, other, 2);
}

// Lab 6.7 -----------------------------------------------------------------------------------------

double multi_sample(const Function& f, const Technique& first, const Technique& second,
                    Heuristic heuristic, carlo::Rng& rng) {
  const auto half = [&](const Technique& own, const Technique& other) {
    const auto n_own = static_cast<double>(own.samples);
    const auto n_other = static_cast<double>(other.samples);
    double sum = 0;
    for (std::int64_t i = 0; i < own.samples; ++i) {
      const double x = own.density.sample(rng.uniform());
      const double weight = heuristic({n_own, own.density.pdf(x)}, {n_other, other.density.pdf(x)});
      sum += weight * contribution(f, own.density, x) / n_own;
    }
    return sum;
  };
  const double from_first = half(first, second);
  return from_first + half(second, first);
}

double one_sample(const Function& f, const Density& first, const Density& second, double share,
                  Heuristic heuristic, double u) {
  const Choice choice = choose(u, share);
  const Density& own = choice.first ? first : second;
  const Density& other = choice.first ? second : first;
  const double chance = choice.first ? share : 1 - share;
  const double x = own.sample(choice.u);
  const double weight = heuristic({chance, own.pdf(x)}, {1 - chance, other.pdf(x)});
  return weight * contribution(f, own, x) / chance;
}

}  // namespace lab06
