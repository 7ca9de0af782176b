#include "stats/gamma.h"

#include <cmath>
#include <limits>
#include <numbers>

namespace carlo {
namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();

/// The series need some 8 sqrt(a) terms, and beyond 1e15 would not end: x / k rounds to 1.
bool in_domain(double a, double x) {
  return a > 0 && a <= 1e12 && x >= 0;
}

/// log(x / a) - (x - a) / a, without cancellation where x is near a.
double log_ratio_minus(double x, double a) {
  const double t = (x - a) / a;
  if (std::abs(t) > 0.3) return std::log(x / a) - t;
  // log(1 + t) = 2 atanh(r); t - 2 r = r t.
  const double r = t / (2 + t), y = r * r;
  double sum = 0, power = 1;
  for (int k = 3; power > epsilon * sum; k += 2) {
    sum += power / k;
    power *= y;
  }
  return r * (2 * y * sum - t);
}

/// log Gamma(a + 1) minus Stirling's formula for it, a >= 10.
double stirling_error(double a) {
  const double s = 1 / (a * a);
  return (1.0 / 12 - s * (1.0 / 360 - s * (1.0 / 1260 - s * (1.0 / 1680 - s / 1188)))) / a;
}

/// P(a, x) over its first term, for x < a + 1.
double lower_series(double a, double x) {
  double term = 1, sum = 1, k = a;
  while (term > epsilon * sum) {
    k += 1;
    term *= x / k;
    sum += term;
  }
  return sum;
}

/// Q(a, x) over a times the same term, for x >= a + 1: the continued fraction by Lentz's method.
double upper_fraction(double a, double x) {
  double b = x + 1 - a, c = 1 / std::numeric_limits<double>::min(), d = 1 / b, value = d;
  double i = 0;
  while (true) {
    i += 1;
    const double numerator = i * (a - i);
    b += 2;
    d = 1 / (numerator * d + b);
    c = b + numerator / c;
    const double step = d * c;
    value *= step;
    if (std::abs(step - 1) < 4 * epsilon || !std::isfinite(value)) return value;
  }
}

}  // namespace

double log_poisson(double a, double x) {
  if (a < 10) return a * std::log(x) - x - std::lgamma(a + 1);
  return a * log_ratio_minus(x, a) - 0.5 * std::log(2 * std::numbers::pi * a) - stirling_error(a);
}

double gamma_lower(double a, double x) {
  if (!in_domain(a, x)) return std::numeric_limits<double>::quiet_NaN();
  if (x == 0) return 0;
  if (std::isinf(x)) return 1;
  if (x >= a + 1) return 1 - gamma_upper(a, x);
  return std::exp(log_poisson(a, x)) * lower_series(a, x);
}

double gamma_upper(double a, double x) {
  if (!in_domain(a, x)) return std::numeric_limits<double>::quiet_NaN();
  if (x == 0) return 1;
  if (std::isinf(x)) return 0;
  if (x < a + 1) return 1 - gamma_lower(a, x);
  return a * std::exp(log_poisson(a, x)) * upper_fraction(a, x);
}

}  // namespace carlo
