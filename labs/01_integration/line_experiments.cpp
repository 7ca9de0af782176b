#include "experiments.h"
#include "integrands.h"

#include <cmath>

// One dimension: the average, and Monte Carlo beside the classical rules.

namespace lab01 {
namespace {

/// Errors of Monte Carlo estimates of `integrand` by `method`(n, rng) for growing n.
Curve monte_carlo_curve(Notebook& notebook, const Integrand& integrand,
                        const std::function<double(std::int64_t, carlo::Rng&)>& method) {
  Curve curve{"Monte Carlo", {}};
  carlo::Rng rng = notebook.rng();
  const auto rungs = ladder(16, notebook.options().n);
  for (std::size_t i = 0; i < rungs.size(); ++i) {
    notebook.progress(static_cast<double>(i), static_cast<double>(rungs.size()));
    const auto trial = [&] { return Trial{method(rungs[i], rng), integrand.integral}; };
    curve.runs.push_back(
        repeat(rungs[i], notebook.repetitions(128), Summary::root_mean_square, trial));
  }
  return curve;
}

using Rule = double (*)(const Function&, double, double, std::int64_t);

Curve rule_curve(const std::string& name, Rule rule, const Integrand& g, std::int64_t last,
                 const std::function<std::int64_t(std::int64_t)>& evaluations) {
  Curve curve{name, {}};
  for (std::int64_t n = 4; evaluations(n) <= last + 1; n *= 4) {
    curve.runs.push_back(
        time_rule(evaluations(n), g.integral, [&] { return rule(g.f, g.a, g.b, n); }));
  }
  return curve;
}

}  // namespace

void average_experiment(Notebook& notebook) {
  notebook.begin("The average");
  const Integrand g = exponential();
  notebook.attempt([&] {
    const Curve measured = monte_carlo_curve(
        notebook, g, [&](std::int64_t n, carlo::Rng& rng) { return average(g.f, n, rng); });
    notebook.say(
        "The average of exp(x) over [0, 1) from N uniform points. The error is the root mean "
        "square over many repetitions; the time is that of one estimate.");
    const double sigma = std::sqrt((std::exp(2.0) - 1) / 2 - g.integral * g.integral);
    Curve predicted{"σ / √N, predicted", measured.runs};
    for (Measurement& m : predicted.runs) {
      m.error = sigma / std::sqrt(static_cast<double>(m.points));
    }
    notebook.table("average", measurement_table({measured}), "Average of exp(x)");
    notebook.table("average_slopes", slope_table({{measured, "-1/2"}}),
                   "Slope of log error, with 95 % interval");
    auto charts = error_charts("Average of exp(x)", "RMS error", {measured});
    charts[0].series.push_back(error_charts("", "", {predicted}, false)[0].series[0]);
    notebook.charts(charts);
  });
}

void rules_experiment(Notebook& notebook) {
  notebook.begin("Dice against rules, in one dimension");
  const Integrand g = reciprocal();
  const std::int64_t last = notebook.options().n;
  std::vector<ExpectedCurve> curves;
  const auto attempt = [&](const char* slope, const auto& make) {
    notebook.attempt([&] { curves.push_back({make(), slope}); });
  };
  attempt("-1/2", [&] {
    return monte_carlo_curve(notebook, g, [&](std::int64_t n, carlo::Rng& rng) {
      return integrate(g.f, g.a, g.b, n, rng);
    });
  });
  attempt("-2", [&] {
    return rule_curve("midpoint", midpoint, g, last, [](std::int64_t n) { return n; });
  });
  attempt("-2", [&] {
    return rule_curve("trapezoid", trapezoid, g, last, [](std::int64_t n) { return n + 1; });
  });
  attempt("-4", [&] {
    return rule_curve("Simpson", simpson, g, last, [](std::int64_t n) { return 2 * n + 1; });
  });
  if (curves.empty()) return;

  notebook.say(
      "The integral of 1/x over [1, 3], which is ln 3. N counts evaluations of the integrand, the "
      "same unit for all. Rules have no randomness: their error is |estimate - ln 3|. Points below "
      "the rounding errors of double are drawn but not fitted.");
  const std::vector<Curve> plain = curves_of(curves);
  notebook.table("rules", measurement_table(plain, 3), "Integral of 1/x over [1, 3]");
  notebook.table("rules_slopes", slope_table(curves), "Slope of log error, with 95 % interval");
  notebook.charts(error_charts("Integral of 1/x", "error", plain));
  notebook.data("rules_all", measurement_table(plain), "Integral of 1/x: all measurements");
}

}  // namespace lab01
