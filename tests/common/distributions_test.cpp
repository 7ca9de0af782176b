#include "stats/distributions.h"

#include <catch2/catch_test_macros.hpp>

#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

namespace {

bool close(double a, double b, double relative) {
  return std::abs(a - b) <= relative * std::abs(b);
}

}  // namespace

// Reference values: Abramowitz and Stegun, tables 26.1 and 26.8, and closed forms.
TEST_CASE("normal tails keep their accuracy far out", "[stats]") {
  CHECK(close(carlo::normal_two_sided(1.959963984540054), 0.05, 1e-12));
  CHECK(close(carlo::normal_two_sided(-1.959963984540054), 0.05, 1e-12));
  CHECK(carlo::normal_two_sided(0) == 1);
  // phi(z) 2 / z (1 - 1/z^2 + 3/z^4 - ...) at z = 20.
  CHECK(close(carlo::normal_two_sided(20), 5.507248237212467e-89, 1e-9));
  for (const double p : {1.0, 0.5, 1e-3, 1.56e-8, 1e-200}) {
    CHECK(close(carlo::normal_two_sided(carlo::normal_two_sided_quantile(p)), p, 1e-9));
  }
  CHECK_THROWS_AS(carlo::normal_two_sided_quantile(0), std::domain_error);
  CHECK_THROWS_AS(carlo::normal_two_sided_quantile(1.5), std::domain_error);
  CHECK(std::isnan(carlo::normal_two_sided(std::numeric_limits<double>::quiet_NaN())));
}

TEST_CASE("chi-square quantiles and noncentralities agree with closed forms", "[stats]") {
  for (const double p : {1e-100, 1e-9, 0.01, 0.5, 0.99}) {
    CHECK(close(carlo::chi_square_upper_quantile(p, 2), -2 * std::log(p), 1e-12));
    CHECK(close(carlo::chi_square_lower_quantile(p, 2), -2 * std::log1p(-p), 1e-12));
    CHECK(close(carlo::chi_square_upper_quantile(p, 1),
                std::pow(carlo::normal_two_sided_quantile(p), 2), 1e-10));
  }
  // The square of Z + d: P((Z + d)^2 <= x) = P(-sqrt(x) - d <= Z <= sqrt(x) - d).
  for (const double x : {1.0, 30.0, 900.0}) {
    for (const double p : {1e-3, 0.05, 0.5}) {
      const double d = std::sqrt(carlo::chi_square_noncentrality(x, 1, p));
      const double below = std::erfc((d - std::sqrt(x)) / std::sqrt(2.0)) / 2 -
                           std::erfc((d + std::sqrt(x)) / std::sqrt(2.0)) / 2;
      CHECK(close(below, p, 1e-6));
    }
  }
  CHECK_THROWS_AS(carlo::chi_square_upper_quantile(-1, 2), std::domain_error);
}

// For 2 n degrees of freedom the upper tail is the probability that a Poisson number of mean x / 2
// is below n. The largest term comes from Stirling's series, in which everything of the size of n
// log n has cancelled.
TEST_CASE("chi-square tails are Poisson sums for many degrees of freedom", "[stats]") {
  for (const double n : {50.0, 5e3, 5e5, 5e6}) {
    for (const double z : {-5.0, -1.0, 0.0, 3.0, 8.0}) {
      const double mean = n + z * std::sqrt(n), off = (mean - n) / n;
      const double log_term = (n - 1) * std::log1p(off) - n * off -
                              std::log(2 * std::numbers::pi * n) / 2 - 1 / (12 * n) +
                              1 / (360 * n * n * n);
      double term = std::exp(log_term), below = 0;
      for (auto k = static_cast<long>(n) - 1; k >= 0 && term > 1e-18 * below; --k) {
        below += term;
        term *= static_cast<double>(k) / mean;
      }
      CHECK(close(carlo::chi_square_upper(2 * mean, 2 * n), below, 2e-9));
    }
  }
}

TEST_CASE("chi-square tails agree with closed forms", "[stats]") {
  for (const double x : {0.1, 1.0, 10.0, 200.0}) {
    // Two degrees of freedom give an exponential, one gives a squared normal.
    CHECK(close(carlo::chi_square_upper(x, 2), std::exp(-x / 2), 1e-12));
    CHECK(close(carlo::chi_square_upper(x, 1), carlo::normal_two_sided(std::sqrt(x)), 1e-10));
    CHECK(close(carlo::chi_square_lower(x, 2), -std::expm1(-x / 2), 1e-12));
  }
  CHECK(close(carlo::chi_square_two_sided(std::log(4), 2), 1, 1e-12));
  CHECK(carlo::chi_square_upper(std::numeric_limits<double>::infinity(), 3) == 0);
  CHECK(std::isnan(carlo::chi_square_two_sided(std::numeric_limits<double>::quiet_NaN(), 3)));
}

TEST_CASE("the Kolmogorov-Smirnov tail has its tabled points", "[stats]") {
  // P(sqrt(n) D >= 1.3581) = .05 and 1.6276: .01, for large n.
  CHECK(close(carlo::kolmogorov_smirnov(1.3581e-3, 1'000'000), 0.05, 2e-3));
  CHECK(close(carlo::kolmogorov_smirnov(1.6276e-3, 1'000'000), 0.01, 2e-3));
  CHECK(carlo::kolmogorov_smirnov(0, 100) == 1);
  CHECK(carlo::kolmogorov_smirnov(1, 1000) < 1e-300);
}

TEST_CASE("Sidak's levels multiply back to the family's", "[stats]") {
  CHECK(close(1 - std::pow(1 - carlo::sidak(0.05, 10), 10), 0.05, 1e-12));
  CHECK(close(carlo::sidak(1e-6, 64), 1.5625e-8, 1e-5));
}
