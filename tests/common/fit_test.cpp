#include "stats/fit.h"

#include "random/rng.h"
#include "stats/running_mean.h"
#include "support/error.h"

#include <boost/math/distributions/students_t.hpp>
#include <catch2/catch_test_macros.hpp>

#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

using carlo::fit_power_law;
using carlo::PowerFit;

namespace {

const std::vector<double> places = {16, 64, 256, 1024, 4096, 16384, 65536, 262144};

std::vector<double> power_law(double scale, double slope) {
  std::vector<double> y;
  for (const double x : places)
    y.push_back(scale * std::pow(x, slope));
  return y;
}

double normal(carlo::Rng& rng) {
  const double u = 1 - rng.uniform();
  const double v = rng.uniform();
  return std::sqrt(-2 * std::log(u)) * std::cos(2 * std::numbers::pi * v);
}

}  // namespace

TEST_CASE("An exact power law is found with an interval of no width", "[fit]") {
  for (const double slope : {-4.0, -0.5, 0.0, 1.5}) {
    const PowerFit fit = fit_power_law(places, power_law(3, slope));
    CHECK(std::fabs(fit.slope - slope) <= 1e-13);
    CHECK(fit.slope_half_width <= 1e-12);
    CHECK(std::fabs(fit.at(100) / (3 * std::pow(100, slope)) - 1) <= 1e-12);
    CHECK(std::fabs(fit.band_factor(1e9) - 1) <= 1e-11);
  }
}

TEST_CASE("The fit agrees with a case worked by hand", "[fit]") {
  // log x = 0, 1, 2 and log y = 0, 1, 0: slope 0, intercept 1/3, residuals -1/3, 2/3, -1/3, so
  // sigma^2 = (6/9) / 1 and the half width is t(1 degree, 97.5 %) sqrt(6/9 / 2) = 12.70620 /
  // sqrt 3.
  const double e = std::numbers::e;
  const PowerFit fit = fit_power_law(std::array{1.0, e, e * e}, std::array{1.0, e, 1.0});
  CHECK(std::fabs(fit.slope) <= 1e-15);
  CHECK(std::fabs(fit.log_scale - 1.0 / 3) <= 1e-15);
  CHECK(std::fabs(fit.slope_half_width - 12.706204736 / std::sqrt(3.0)) <= 1e-7);
}

TEST_CASE("Student's quantile is Boost's", "[fit]") {
  for (const std::size_t freedom : {1U, 2U, 3U, 4U, 5U, 6U, 15U, 38U, 97U, 1000U, 10'001U}) {
    const boost::math::students_t student(static_cast<double>(freedom));
    for (const double confidence : {1e-6, 0.1, 0.5, 0.9, 0.95, 0.99, 0.999, 1 - 1e-6, 1 - 1e-9}) {
      CAPTURE(freedom, confidence);
      const double t = carlo::student_half_width(confidence, freedom);
      const double tail = 2 * boost::math::cdf(boost::math::complement(student, t));
      CHECK(std::fabs(tail - (1 - confidence)) <= 1e-13);
      if (confidence >= 0.1 && confidence <= 0.999) {
        const double boosts = boost::math::quantile(student, (1 + confidence) / 2);
        CHECK(std::fabs(t / boosts - 1) <= 1e-11);
      }
    }
  }
}

TEST_CASE("A weight counts like repeated points", "[fit]") {
  const std::array x{1.0, 2.0, 5.0}, y{1.0, 3.0, 4.0}, weights{1.0, 2.0, 1.0};
  const PowerFit weighted = fit_power_law(x, y, weights);
  const PowerFit repeated =
      fit_power_law(std::array{1.0, 2.0, 2.0, 5.0}, std::array{1.0, 3.0, 3.0, 4.0});
  CHECK(std::fabs(weighted.slope - repeated.slope) <= 1e-14);
  CHECK(std::fabs(weighted.log_scale - repeated.log_scale) <= 1e-14);
}

TEST_CASE("The 95 % intervals of slope and line hold the truth in 95 % of the trials", "[fit]") {
  // n = 4000 trials: the rate's standard deviation is sqrt(.95 .05 / 4000) = .00345. 5 of them are
  // allowed, alpha = 6e-7 per check. Using the normal quantile 1.96 for Student's 2.447 would cover
  // .902, which is 13.9 standard deviations off: power > .999.
  constexpr int trials = 4000;
  carlo::Rng rng(20);
  int slope_held = 0, line_held = 0;
  for (int i = 0; i < trials; ++i) {
    std::vector<double> y = power_law(2, -0.5);
    for (double& value : y)
      value *= std::exp(0.1 * normal(rng));
    const PowerFit fit = fit_power_law(places, y);
    if (std::fabs(fit.slope + 0.5) <= fit.slope_half_width) ++slope_held;
    const double off = std::fabs(std::log(fit.at(1e4) / (2 * std::pow(1e4, -0.5))));
    if (off <= std::log(fit.band_factor(1e4))) ++line_held;
  }
  CHECK(std::fabs(slope_held / double{trials} - 0.95) <= 0.0173);
  CHECK(std::fabs(line_held / double{trials} - 0.95) <= 0.0173);
}

TEST_CASE("Two power laws cross where both have the same value", "[fit]") {
  const PowerFit steep = fit_power_law(places, power_law(8, -1));
  const PowerFit flat = fit_power_law(places, power_law(2, -0.5));
  CHECK(std::fabs(carlo::crossing(steep, flat) / 16 - 1) <= 1e-11);
  CHECK(std::isinf(carlo::crossing(flat, flat)));
}

TEST_CASE("A fit refuses what has no logarithm or no slope", "[fit]") {
  const std::array one_two_three{1.0, 2.0, 3.0};
  const double nan = std::nan(""), infinite = std::numeric_limits<double>::infinity();
  for (const double bad : {0.0, -1.0, nan, infinite}) {
    CHECK_THROWS_AS(fit_power_law(one_two_three, std::array{1.0, bad, 3.0}), carlo::Error);
    CHECK_THROWS_AS(fit_power_law(std::array{1.0, bad, 3.0}, one_two_three), carlo::Error);
    CHECK_THROWS_AS(fit_power_law(one_two_three, one_two_three, std::array{1.0, bad, 1.0}),
                    carlo::Error);
  }
  CHECK_THROWS_AS(fit_power_law(std::array{1.0, 2.0}, std::array{1.0, 2.0}), carlo::Error);
  CHECK_THROWS_AS(fit_power_law(one_two_three, std::array{1.0, 2.0}), carlo::Error);
  CHECK_THROWS_AS(fit_power_law(one_two_three, one_two_three, std::array{1.0}), carlo::Error);
  CHECK_THROWS_AS(fit_power_law(std::array{7.1, 7.1, 7.1}, one_two_three), carlo::Error);
  CHECK_THROWS_AS(fit_power_law(one_two_three, one_two_three, {}, 1.0), carlo::Error);
}

TEST_CASE("A running mean has the mean and the spread of its numbers, however far from 0 they lie",
          "[fit]") {
  for (const double offset : {0.0, 1e9}) {
    carlo::RunningMean mean;
    for (int i = 1; i <= 9; ++i)
      mean.add(offset + i);
    // For 1 to n: mean (n + 1)/2, variance n (n + 1)/12.
    CHECK(mean.count() == 9);
    CHECK(mean.mean() == offset + 5);
    CHECK(std::abs(mean.deviation() - std::sqrt(7.5)) < 1e-12);
    CHECK(std::abs(mean.error() - std::sqrt(7.5 / 9)) < 1e-12);
  }
}
