#include "stats/distributions.h"

#include <boost/math/distributions/non_central_chi_squared.hpp>
#include <boost/math/special_functions/erf.hpp>
#include <boost/math/special_functions/gamma.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace carlo {

double normal_two_sided(double z) {
  return std::erfc(std::abs(z) / std::numbers::sqrt2);
}

double normal_two_sided_quantile(double p) {
  if (!(p > 0 && p <= 1)) throw std::domain_error("normal_two_sided_quantile: p outside (0, 1]");
  return std::numbers::sqrt2 * boost::math::erfc_inv(p);
}

double chi_square_lower(double x, double dof) {
  if (std::isnan(x)) return x;
  return std::isinf(x) ? 1 : boost::math::gamma_p(dof / 2, x / 2);
}

double chi_square_upper(double x, double dof) {
  if (std::isnan(x)) return x;
  return std::isinf(x) ? 0 : boost::math::gamma_q(dof / 2, x / 2);
}

double chi_square_lower_quantile(double p, double dof) {
  return 2 * boost::math::gamma_p_inv(dof / 2, p);
}

double chi_square_upper_quantile(double p, double dof) {
  return 2 * boost::math::gamma_q_inv(dof / 2, p);
}

double chi_square_noncentrality(double x, double dof, double p) {
  return boost::math::non_central_chi_squared::find_non_centrality(dof, x, p);
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
