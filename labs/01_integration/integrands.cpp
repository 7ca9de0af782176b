#include "integrands.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace lab01 {

Integrand exponential() {
  return {"exp(x) on [0, 1]", [](double x) { return std::exp(x); }, 0, 1, std::expm1(1.0)};
}

Integrand reciprocal() {
  return {"1/x on [1, 3]", [](double x) { return 1 / x; }, 1, 3, std::log(3.0)};
}

Integrand jump(double edge) {
  return {"jump", [edge](double x) { return x < edge ? 1.0 : 0.0; }, 0, 1, edge};
}

Integrand singular(double power) {
  // A uniform number can be 0, though it hardly ever is; half the smallest positive one replaces
  // it, so that no estimate is infinite.
  const auto f = [power](double x) { return std::pow(std::max(x, 0x1p-54), -power); };
  return {fmt::format("x^-{}", power), f, 0, 1, 1 / (1 - power)};
}

Integrand spike(double width, double left) {
  const auto f = [=](double x) { return x >= left && x < left + width ? 1 + 1 / width : 1.0; };
  return {"rare spike", f, 0, 1, 2};
}

double exponential_nd(std::span<const double> x) {
  return std::exp(std::accumulate(x.begin(), x.end(), 0.0));
}

double exponential_nd_integral(std::size_t dimension) {
  return std::pow(std::expm1(1.0), static_cast<double>(dimension));
}

bool inside_unit_ball(std::span<const double> x) {
  return std::inner_product(x.begin(), x.end(), x.begin(), 0.0) <= 1;
}

double unit_ball_volume(std::size_t dimension) {
  const double half = static_cast<double>(dimension) / 2;
  return std::pow(std::numbers::pi, half) / std::tgamma(half + 1);
}

}  // namespace lab01
