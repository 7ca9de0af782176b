// Tests the solution at the limits of double, against values computed by hand.

#include "importance.h"

#include <catch2/catch_test_macros.hpp>

#include <cmath>
#include <limits>
#include <vector>

using namespace lab06;

TEST_CASE("a mean of 1e12 hides no spread") {
  // Half of them 1e12, half 1e12 + 1: variance .25 n / (n - 1).
  std::vector<double> values;
  constexpr int n = 1000000;
  for (int i = 0; i < n; ++i)
    values.push_back(1e12 + i % 2);
  const Estimate estimate = summarize(values);
  CHECK(estimate.value == 1e12 + 0.5);
  CHECK(std::abs(estimate.variance / (0.25 * n / (n - 1)) - 1) <= 1e-12);
}

TEST_CASE("a light close to the ray, far from the segment") {
  // For height -> 0 the density on [a, b] is a b / ((b - a) t^2), the quantile a b / (b - u (b -
  // a)).
  for (const double height : {1e-3, 1e-6, 1e-9, 1e-12, 1e-16, 1e-30, 1e-100}) {
    const Density density = light_density(height, 1, 2);
    const double bound = 1e-14 + 10 * height * height;
    for (const double u : {0.0, 0.1, 0.5, 0.9, 0x1.fffffffffffffp-1}) {
      INFO("height " << height << ", u " << u);
      const double t = density.sample(u), exact = 2 / (2 - u);
      CHECK(std::abs(t / exact - 1) <= bound);
      CHECK(std::abs(density.pdf(exact) * exact * exact / 2 - 1) <= bound);
    }
  }
}

TEST_CASE("a light beside the segment still draws all of it") {
  for (const double height : {1e-6, 1.0, 1e6}) {
    const Density density = light_density(height, -1, 1);
    CHECK(density.sample(0) == -1);
    CHECK(std::abs(density.sample(0.5)) <= 1e-9);
    CHECK(std::abs(density.sample(0x1.fffffffffffffp-1) - 1) <= 1e-6);
    CHECK(std::abs(density.pdf(0) * 2 * std::atan(1 / height) * height - 1) <= 1e-14);
  }
}

TEST_CASE("weights of products that are too large or too small, or only look so") {
  CHECK(balance_weight({1e200, 1e-200}, {1e-200, 1e200}) == 0.5);
  CHECK(power_weight({1e-200, 1e200}, {1e200, 1e-200}) == 0.5);
  CHECK(std::abs(balance_weight({1e300, 1e300}, {3e300, 1e300}) - 0.25) <= 1e-15);
  CHECK(std::abs(power_weight({1e-300, 1e-300}, {3e-300, 1e-300}) - 0.1) <= 1e-15);
  CHECK(balance_weight({1, 1e-320}, {1, 1e-320}) == 0.5);
  CHECK(balance_weight({1e-300, 1e-300}, {1e300, 1e300}) == 0);
  CHECK(balance_weight({1e300, 1e300}, {1e-300, 1e-300}) == 1);
  const double infinite = std::numeric_limits<double>::infinity();
  CHECK(balance_weight({1, infinite}, {5, 1e300}) == 1);
  CHECK(balance_weight({5, 1e300}, {1, infinite}) == 0);
}
