#include "densities.h"

#include <cmath>

namespace lab06 {

Density uniform_density(double a, double b) {
  return {[=](double u) { return a + (b - a) * u; },
          [=](double x) { return x >= a && x < b ? 1 / (b - a) : 0; }};
}

Density power_density(double n) {
  return {[=](double u) { return std::pow(u, 1 / (n + 1)); },
          [=](double x) { return x >= 0 && x <= 1 ? (n + 1) * std::pow(x, n) : 0; }};
}

Density exponential_density(double rate, double from) {
  return {[=](double u) { return from - std::log1p(-u) / rate; },
          [=](double x) { return x >= from ? rate * std::exp(-rate * (x - from)) : 0; }};
}

Density logistic_density(double centre, double scale) {
  // u = 0 would be infinitely far out; it is moved to where the density is 1e-300 / scale.
  return {[=](double u) { return centre + scale * (u > 0 ? std::log(u / (1 - u)) : -690.0); },
          [=](double x) {
            const double e = std::exp(-std::abs(x - centre) / scale);
            return e / (scale * (1 + e) * (1 + e));
          }};
}

double logistic_cdf(double x, double centre, double scale) {
  return 1 / (1 + std::exp(-(x - centre) / scale));
}

}  // namespace lab06
