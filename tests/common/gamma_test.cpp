// The incomplete gamma functions and what is built on them, against Boost.Math in long double.

#include "stats/gamma.h"

#include "stats/distributions.h"

#include <boost/math/distributions/non_central_chi_squared.hpp>
#include <boost/math/special_functions/erf.hpp>
#include <boost/math/special_functions/gamma.hpp>
#include <catch2/catch_test_macros.hpp>

#include <cmath>
#include <limits>
#include <stdexcept>

namespace {

/// True if a and b differ by this fraction at most; both may be below the least normal double.
bool close(double a, long double b, double relative) {
  const auto expected = static_cast<double>(b);
  return std::abs(a - expected) <= relative * std::abs(expected) + 1e-300;
}

double accuracy(double a) {
  return a <= 1e4 ? 1e-12 : 1e-10;
}

}  // namespace

TEST_CASE("incomplete gamma functions agree with Boost.Math's", "[stats]") {
  for (const double a : {1e-3, 0.25, 0.5, 1.0, 1.5, 9.5, 10.0, 37.0, 1e3, 1e4, 1e6, 1e7}) {
    for (const double z : {-30.0, -8.0, -3.0, -0.5, 0.0, 0.7, 4.0, 12.0, 30.0}) {
      for (const double x : {a + z * std::sqrt(a), a * std::exp(z)}) {
        if (!(x > 0)) continue;
        INFO(a << " " << x);
        CHECK(
            close(carlo::gamma_lower(a, x), boost::math::gamma_p<long double>(a, x), accuracy(a)));
        CHECK(
            close(carlo::gamma_upper(a, x), boost::math::gamma_q<long double>(a, x), accuracy(a)));
      }
    }
  }
}

TEST_CASE("incomplete gamma functions are NaN outside their domain, and end near its limit",
          "[stats]") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const auto function : {carlo::gamma_lower, carlo::gamma_upper}) {
    for (const double a : {0.0, -1.0, 1e15, nan})
      CHECK(std::isnan(function(a, 1)));
    for (const double x : {-1e-300, nan})
      CHECK(std::isnan(function(1, x)));
    // The median of a gamma variable of shape a is a - 1/3 + O(1/a).
    CHECK(close(function(1e12, 1e12 - 1.0 / 3), 0.5L, 1e-9));
  }
  CHECK(std::isnan(carlo::chi_square_two_sided(1, 0)));
  CHECK_THROWS_AS(carlo::chi_square_upper_quantile(nan, 3), std::domain_error);
}

TEST_CASE("quantiles of chi-square agree with Boost.Math's", "[stats]") {
  for (const double dof : {0.5, 1.0, 2.0, 3.0, 17.0, 255.0, 4095.0, 1e6}) {
    for (const double p : {1e-250, 1e-30, 1e-9, 1.56e-8, 1e-3, 0.3, 0.5, 0.7, 0.999, 1 - 1e-9}) {
      INFO(dof << " " << p);
      const long double lower = 2 * boost::math::gamma_p_inv<long double>(dof / 2, p);
      const long double upper = 2 * boost::math::gamma_q_inv<long double>(dof / 2, p);
      CHECK(close(carlo::chi_square_lower_quantile(p, dof), lower, 1e-11));
      CHECK(close(carlo::chi_square_upper_quantile(p, dof), upper, 1e-11));
    }
  }
  for (const double p : {1e-300, 1e-100, 1e-20, 1e-8, 0.01, 0.5, 0.9, 0.999999})
    CHECK(close(carlo::normal_two_sided_quantile(p),
                std::sqrt(2.0L) * boost::math::erfc_inv<long double>(p), 1e-11));
}

TEST_CASE("noncentralities agree with Boost.Math's", "[stats]") {
  for (const double dof : {1.0, 3.0, 40.0, 1000.0, 1e5}) {
    const double x = carlo::chi_square_upper_quantile(1e-9, dof);
    for (const double p : {1e-4, 0.01, 0.1, 0.5}) {
      INFO(dof << " " << p);
      CHECK(close(carlo::chi_square_noncentrality(x, dof, p),
                  boost::math::non_central_chi_squared::find_non_centrality(dof, x, p), 1e-6));
    }
  }
}
