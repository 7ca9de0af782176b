#include "grader/calibrate/rates.h"

#include "random/rng.h"
#include "stats/distributions.h"
#include "support/error.h"

#include <catch2/catch_test_macros.hpp>

#include <cmath>

using namespace carlo::grader;

namespace {

bool close(double a, double b, double relative) {
  return std::abs(a - b) <= relative * std::abs(b);
}

/// Draws `count` numbers of density k x^(k-1) on [0, 1).
std::vector<double> powers(std::uint64_t seed, int count, double k) {
  carlo::Rng rng(seed);
  std::vector<double> values;
  for (int i = 0; i < count; ++i)
    values.push_back(std::pow(rng.uniform(), 1 / k));
  return values;
}

}  // namespace

TEST_CASE("Clopper and Pearson's bound is what it is by hand", "[calibrate]") {
  // Without failures: (1 - bound)^n = .05.
  for (const std::size_t n : {1U, 25U, 1000U, 1'000'000U}) {
    CHECK(close(rate_upper_bound(0, n), -std::expm1(std::log(.05) / static_cast<double>(n)), 1e-9));
  }
  // n - 1 failures of n: 1 - bound^n = .05.
  CHECK(close(rate_upper_bound(9, 10), std::pow(.95, .1), 1e-9));
  // 1 of 2: (1 - b)^2 + 2 b (1 - b) = .05, so 1 - b^2 = .05.
  CHECK(close(rate_upper_bound(1, 2), std::sqrt(.95), 1e-9));
  CHECK(rate_upper_bound(3, 3) == 1);
  CHECK(rate_upper_bound(0, 0) == 1);
  CHECK(close(rate_upper_bound(0, 10, .5), -std::expm1(std::log(.5) / 10), 1e-9));
  CHECK_THROWS_AS(rate_upper_bound(2, 1), carlo::Error);
}

TEST_CASE("Clopper and Pearson's bound puts 5 % below its count", "[calibrate]") {
  // P(at most k failures in n) at the bound, summed by hand, is 1 - confidence.
  const std::size_t n = 40;
  for (const std::size_t k : {1U, 5U, 20U, 38U}) {
    const double bound = rate_upper_bound(k, n, .99);
    double sum = 0;
    for (std::size_t i = 0; i <= k; ++i) {
      const auto x = static_cast<double>(i), m = static_cast<double>(n);
      sum += std::exp(std::lgamma(m + 1) - std::lgamma(x + 1) - std::lgamma(m - x + 1) +
                      x * std::log(bound) + (m - x) * std::log1p(-bound));
    }
    CHECK(close(sum, .01, 1e-8));
  }
}

TEST_CASE("the one-sided Kolmogorov-Smirnov tail agrees with closed forms", "[calibrate]") {
  // One value u: D+ = 1 - u. Two: P(D+ >= d) = (1 - d)^2 + 2 d (1/2 - d), d < 1/2.
  CHECK(close(carlo::one_sided_kolmogorov_smirnov(.3, 1), .7, 1e-12));
  CHECK(close(carlo::one_sided_kolmogorov_smirnov(.2, 2), .8 * .8 + 2 * .2 * (.5 - .2), 1e-12));
  // Many: exp(-2 n d^2), and half of the two-sided tail far out.
  const double d = 3 / std::sqrt(20'000.0);
  CHECK(close(carlo::one_sided_kolmogorov_smirnov(d, 20'000), std::exp(-18.0), .05));
  CHECK(close(2 * carlo::one_sided_kolmogorov_smirnov(.2, 200), carlo::kolmogorov_smirnov(.2, 200),
              .05));
  CHECK(carlo::one_sided_kolmogorov_smirnov(0, 10) == 1);
  CHECK(carlo::one_sided_kolmogorov_smirnov(1, 10) == 0);
  CHECK(std::isnan(carlo::one_sided_kolmogorov_smirnov(std::nan(""), 10)));
}

// 4000 trials of 30 values: a tail that is off by a tenth at 1 % would show at 6 standard errors
// only from .02 on; at 10 %, which is also tested, .1 +- .028 holds with z = 5.9.
TEST_CASE("the one-sided test fails uniform values as often as it says", "[calibrate]") {
  int below = 0;
  constexpr int trials = 4000;
  for (int i = 0; i < trials; ++i)
    below += uniformity(powers(static_cast<std::uint64_t>(i) + 1, 30, 1)).too_small < .1 ? 1 : 0;
  CHECK(std::abs(below / double{trials} - .1) <= .028);
}

// 2000 values: x^k is off the diagonal by .18 (k = 1/2 and 2: max of |sqrt(x) - x| is 1/4), more
// than ten times what the level of 1e-3 needs.
TEST_CASE("p-values are told uniform, cautious or too small", "[calibrate]") {
  CHECK(uniformity(powers(3, 2000, 1)).behaviour(1e-6) == Behaviour::uniform);
  CHECK(uniformity(powers(3, 2000, 2)).behaviour(1e-6) == Behaviour::cautious);
  CHECK(uniformity(powers(3, 2000, .5)).behaviour(1e-6) == Behaviour::too_small);
  CHECK(to_string(uniformity(powers(3, 2000, .5)).behaviour(1e-6)) == "too small");
}

TEST_CASE("the p-values of a fair coin's exact test are cautious and tied", "[calibrate]") {
  // 5 throws: the two-sided p-value is 1/16, 3/8 or 1.
  carlo::Rng rng(5);
  std::vector<double> p;
  for (int i = 0; i < 1000; ++i) {
    int heads = 0;
    for (int k = 0; k < 5; ++k)
      heads += rng.uniform() < .5 ? 1 : 0;
    p.push_back(heads == 0 || heads == 5 ? 1 / 16.0 : heads == 1 || heads == 4 ? 3 / 8.0 : 1);
  }
  const Uniformity found = uniformity(p);
  CHECK(found.ties);
  CHECK(found.smallest == 1 / 16.0);
  CHECK(found.behaviour(1e-6) == Behaviour::cautious);
}

TEST_CASE("Kolmogorov-Smirnov p-values, down to 1e-15") {
  // By the matrix of Marsaglia, Tsang and Wang, with 60 decimal digits.
  struct Known {
    std::size_t n;
    double d, p;
  };
  for (const auto& [n, d, p] : {Known{100, .12, 1.033037490e-1}, Known{100, .2, 5.551927328e-4},
                                Known{100, .3, 1.771986989e-8}, Known{100, .4, 5.947617e-15},
                                Known{1000, .05, 1.301207e-2}, Known{1000, .13, 3.401754e-15}}) {
    INFO("n = " << n << ", d = " << d);
    CHECK(std::abs(carlo::kolmogorov_smirnov(d, n) / p - 1) <= .002);
  }
  // At the switch from the exact sum to the approximation.
  CHECK(std::abs(carlo::one_sided_kolmogorov_smirnov(.04, 20000) /
                     carlo::one_sided_kolmogorov_smirnov(.04, 20001) -
                 1) <= .06);
}

TEST_CASE("NaN counts as the smallest p-value, and no p-values as uniform", "[calibrate]") {
  CHECK(uniformity({.5, std::nan("")}).smallest == 0);
  CHECK(uniformity(std::vector<double>(20, std::nan(""))).behaviour(1e-3) == Behaviour::too_small);
  CHECK(uniformity({}).behaviour(1e-3) == Behaviour::uniform);
  CHECK(uniformity({}).count == 0);
}
