#include "experiments.h"
#include "inversion_rejection.h"

#include <cmath>

// The error of a mean, by samples of both kinds: the same at the same N, not at the same time.

namespace lab05 {
namespace {

constexpr double exponent = 7;  // kept: 1 of 8 darts
constexpr double exact_mean = (exponent + 1) / (exponent + 2);

carlo::Curve mean_curve(Notebook& notebook, const std::string& name,
                        const std::function<double(carlo::Rng&)>& draw) {
  carlo::Curve curve{name, {}};
  carlo::Rng rng = notebook.rng();
  for (const std::int64_t n : carlo::ladder(16, notebook.options().n / 4)) {
    const auto trial = [&] {
      double sum = 0;
      for (std::int64_t i = 0; i < n; ++i)
        sum += draw(rng);
      return carlo::Trial{sum / static_cast<double>(n), exact_mean};
    };
    curve.runs.push_back(
        repeat(n, notebook.repetitions(128), carlo::Summary::root_mean_square, trial));
  }
  return curve;
}

}  // namespace

void convergence_experiment(Notebook& notebook) {
  notebook.begin("The same error, not the same time");
  const Function f = [](double x) { return std::pow(x, exponent); };
  std::vector<carlo::Curve> curves;
  const auto add = [&](const std::string& name, const auto& draw) {
    notebook.attempt([&] { curves.push_back(mean_curve(notebook, name, draw)); });
    notebook.progress(static_cast<double>(curves.size()), 2);
  };
  add("inversion", [](carlo::Rng& rng) { return sample_power(rng.uniform(), exponent); });
  add("rejection", [&f](carlo::Rng& rng) { return sample_by_rejection(f, 0, 1, 1, rng).value; });
  if (curves.empty()) return;
  notebook.say(
      "The mean of N samples of the density proportional to x^7 against its exact value 8/9. N "
      "counts accepted samples: these are as good as inverted ones, and slope and error against N "
      "agree. Against seconds the darts that were thrown away show.");
  carlo::Table slopes({"method", "theory", "slope against N", "slope against time"},
                      {"method", "theory", "slope_points", "slope_seconds"});
  for (const carlo::Curve& curve : curves) {
    slopes.add_row({curve.name, "-1/2", carlo::slope_cell(curve.against_points()),
                    carlo::slope_cell(curve.against_seconds())});
  }
  notebook.table("convergence", measurement_table(curves, 2), "Mean of samples of x^7");
  notebook.table("convergence_slopes", slopes, "Slope of log error, with 95 % interval");
  notebook.charts(error_charts("Mean of samples of x^7", "RMS error", curves));
}

}  // namespace lab05
