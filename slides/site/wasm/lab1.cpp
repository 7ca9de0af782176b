// Lab 1: the curse of dimensions, and error bars that miss.

#include "call.h"
#include "integrands.h"

#include <algorithm>

namespace site {
namespace {

using namespace lab01;

/// An integrand on the unit cube: 0 smooth, exp(x_1 + ... + x_d); 1 the part of the unit ball.
struct OnCube {
  FunctionNd f;
  double integral;
};

OnCube on_cube(std::size_t which, std::size_t d) {
  if (which == 0) return {exponential_nd, exponential_nd_integral(d)};
  return {[](std::span<const double> x) { return inside_unit_ball(x) ? 1.0 : 0.0; },
          unit_ball_volume(d) / std::pow(2.0, static_cast<double>(d))};
}

using Rule = double (*)(const lab01::Function&, double, double, std::int64_t);

/// A rule of Lab 1.4 nested in every dimension.
double nested(Rule rule, const FunctionNd& f, std::vector<double>& x, std::size_t k,
              std::int64_t n) {
  const auto inner = [&](double at) {
    x[k] = at;
    return k + 1 == x.size() ? f(x) : nested(rule, f, x, k + 1, n);
  };
  return rule(inner, 0, 1, n);
}

/// d, integrand, rule (0 midpoint, 1 trapezoid, 2 Simpson), cells per side: the relative error.
Numbers rule_error(const Arguments& given) {
  constexpr Rule rules[] = {midpoint, trapezoid, simpson};
  const OnCube cube = on_cube(given.index(1), given.index(0));
  std::vector<double> x(given.index(0));
  const double value = nested(rules[given.index(2)], cube.f, x, 0, given.whole(3));
  return {std::abs(value / cube.integral - 1)};
}

/// d, integrand, N, runs, seed: the RMS relative error of Monte Carlo.
Numbers monte_carlo_error(const Arguments& given) {
  const OnCube cube = on_cube(given.index(1), given.index(0));
  const std::vector<double> lower(given.index(0), 0.0), upper(given.index(0), 1.0);
  carlo::Rng rng = given.rng(4, 2);
  const auto trial = [&] { return integrate_box(cube.f, {lower, upper}, given.whole(2), rng); };
  return {rms_error(given.whole(3), cube.integral, trial) / cube.integral};
}

/// width, N, runs, seed, shown: the share of 95 % intervals that hold the integral, 2; the RMS
/// error; the probability that no point falls on the spike; then mean and standard error of the
/// first runs.
Numbers spike_runs(const Arguments& given) {
  const Integrand integrand = spike(given[0], 0.3);
  const std::int64_t n = given.whole(1), runs = given.whole(2);
  carlo::Rng rng = given.rng(3, 1);
  Numbers results(3);
  for (std::int64_t i = 0; i < runs; ++i) {
    Moments moments;
    for (std::int64_t k = 0; k < n; ++k)
      moments.add(integrand.f(rng.uniform()));
    const double error = moments.mean() - integrand.integral;
    results[0] += std::abs(error) <= 1.96 * moments.standard_error() ? 1 : 0;
    results[1] += error * error;
    if (i < given.whole(4))
      results.insert(results.end(), {moments.mean(), moments.standard_error()});
  }
  results[0] /= static_cast<double>(runs);
  results[1] = std::sqrt(results[1] / static_cast<double>(runs));
  results[2] = std::exp(static_cast<double>(n) * std::log1p(-given[0]));
  return results;
}

const Function functions[] = {
    {"1.rule", rule_error}, {"1.monte_carlo", monte_carlo_error}, {"1.spike", spike_runs}};

}  // namespace
}  // namespace site
