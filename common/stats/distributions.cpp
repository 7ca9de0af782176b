#include "stats/distributions.h"

#include "stats/gamma.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>

namespace carlo {
namespace {

void require(bool holds, const char* function, const char* expected) {
  if (!holds) throw std::domain_error(std::string(function) + ": expected " + expected);
}

/// The x > 0 at which a tail is p, by Newton's method on logarithms of x and of the tail, kept
/// between what is known to be too small and too large. `grows` says whether the tail grows with x;
/// `log_slope(x, tail)` is d log(tail) / d log(x).
template <class Tail, class Slope>
double solve_tail(const Tail& tail, const Slope& log_slope, double p, bool grows, double start) {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  double y = std::log(start);
  for (int i = 0; i < 200; ++i) {
    const double x = std::exp(y), at = tail(x);
    const double off = std::log(at) - std::log(p);
    if (off == 0) return x;
    ((off < 0) == grows ? low : high) = y;
    double next = y - off / log_slope(x, at);
    if (!(next > low && next < high)) {
      next = std::isinf(low) ? high - 1 : std::isinf(high) ? low + 1 : (low + high) / 2;
    }
    if (std::abs(next - y) <= 4 * std::numeric_limits<double>::epsilon() * std::abs(y)) {
      return std::exp(next);
    }
    y = next;
  }
  return std::exp(y);
}

/// d log(tail) / d log(x) of a gamma variable of shape a, whose density is a times this term over
/// x.
double gamma_log_slope(double a, double x, double tail) {
  return a * std::exp(log_poisson(a, x) - std::log(tail));
}

double lower_inverse(double a, double p);

/// The x with Q(a, x) = p.
double upper_inverse(double a, double p) {
  if (p > 0.5) return lower_inverse(a, 1 - p);
  if (p == 0) return std::numeric_limits<double>::infinity();
  return solve_tail([&](double x) { return gamma_upper(a, x); },
                    [&](double x, double q) { return -gamma_log_slope(a, x, q); }, p, false,
                    a - std::log(p));
}

/// The x with P(a, x) = p.
double lower_inverse(double a, double p) {
  if (p > 0.5) return upper_inverse(a, 1 - p);
  if (p == 0) return 0;
  // From where the first term alone is p, which is too small: there the slope is a.
  const double start = std::exp((std::log(p) + std::lgamma(a + 1)) / a);
  return solve_tail([&](double x) { return gamma_lower(a, x); },
                    [&](double x, double q) { return gamma_log_slope(a, x, q); }, p, true,
                    std::max(start, std::numeric_limits<double>::min()));
}

/// P(X <= x) for a noncentral chi-square variable: a Poisson mixture of central ones, summed from
/// the last that matters down, so that P(a, x) grows by positive terms.
double noncentral_lower(double x, double dof, double noncentrality) {
  const double mean = noncentrality / 2, half = x / 2;
  const double last = std::ceil(mean + 12 * std::sqrt(mean) + 40);
  double tail = gamma_lower(dof / 2 + last, half), sum = 0;
  double j = last;
  while (j >= 0) {
    const double weight = j > 0 ? std::exp(log_poisson(j, mean)) : std::exp(-mean);
    sum += weight * tail;
    if (j < mean && weight < 1e-18 * sum) break;
    if (j > 0) tail += std::exp(log_poisson(dof / 2 + j - 1, half));
    j -= 1;
  }
  return sum;
}

}  // namespace

double normal_two_sided(double z) {
  return std::erfc(std::abs(z) / std::numbers::sqrt2);
}

double normal_two_sided_quantile(double p) {
  require(p > 0 && p <= 1, "normal_two_sided_quantile", "0 < p <= 1");
  return std::sqrt(2 * upper_inverse(0.5, p));
}

double chi_square_lower(double x, double dof) {
  return gamma_lower(dof / 2, x / 2);
}

double chi_square_upper(double x, double dof) {
  return gamma_upper(dof / 2, x / 2);
}

double chi_square_lower_quantile(double p, double dof) {
  require(p >= 0 && p < 1 && dof > 0, "chi_square_lower_quantile", "0 <= p < 1 and dof > 0");
  return 2 * lower_inverse(dof / 2, p);
}

double chi_square_upper_quantile(double p, double dof) {
  require(p > 0 && p <= 1 && dof > 0, "chi_square_upper_quantile", "0 < p <= 1 and dof > 0");
  return 2 * upper_inverse(dof / 2, p);
}

double chi_square_noncentrality(double x, double dof, double p) {
  require(x > 0 && dof > 0 && p > 0 && p < gamma_lower(dof / 2, x / 2), "chi_square_noncentrality",
          "0 < p < P(X <= x) of a central variable");
  double low = 0, high = x + 1;
  while (noncentral_lower(x, dof, high) > p)
    low = high, high *= 2;
  while (high - low > 1e-12 * high) {
    const double middle = (low + high) / 2;
    (noncentral_lower(x, dof, middle) > p ? low : high) = middle;
  }
  return (low + high) / 2;
}

double chi_square_two_sided(double x, double dof) {
  const double lower = chi_square_lower(x, dof);
  const double upper = chi_square_upper(x, dof);
  return std::isnan(lower) ? lower : std::min(1.0, 2 * std::min(lower, upper));
}

double one_sided_kolmogorov_smirnov(double d, std::size_t n) {
  if (std::isnan(d)) return d;
  if (!(d > 0)) return 1;
  if (d >= 1) return 0;
  const auto count = static_cast<double>(n);
  if (n > 20000) return std::exp(-(6 * count * d + 1) * (6 * count * d + 1) / (18 * count));
  double sum = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const auto j = static_cast<double>(i);
    if (!(d + j / count < 1)) break;
    const double log_choose =
        std::lgamma(count + 1) - std::lgamma(j + 1) - std::lgamma(count - j + 1);
    sum += std::exp(log_choose + (j - 1) * std::log(d + j / count) +
                    (count - j) * std::log1p(-d - j / count));
  }
  return std::min(1.0, d * sum);
}

double kolmogorov_smirnov(double d, std::size_t n) {
  if (std::isnan(d)) return d;
  const double root = std::sqrt(static_cast<double>(n));
  const double t = (root + 0.12 + 0.11 / root) * d;
  if (t > 1) return std::min(1.0, 2 * one_sided_kolmogorov_smirnov(d, n));
  if (t < 0.2) return 1;  // the series needs many terms there; the value is 1 to 12 digits
  double sum = 0;
  double sign = 1;
  for (int k = 1; k <= 100; ++k) {
    sum += sign * std::exp(-2.0 * k * k * t * t);
    sign = -sign;
  }
  return std::clamp(2 * sum, 0.0, 1.0);
}

double sidak(double alpha, std::size_t count) {
  return -std::expm1(std::log1p(-alpha) / static_cast<double>(count));
}

}  // namespace carlo
