#include "experiments.h"
#include "importance.h"
#include "power_family.h"

#include <algorithm>
#include <vector>

// Error against N and against seconds: the density affects the slope only through its tail.

namespace lab06 {
namespace {

struct EstimatorWay {
  std::string name;
  Density p;
  std::string theory;  ///< the slope
  bool exact = false;  ///< rounding errors only: no slope
};

std::vector<EstimatorWay> convergence_ways() {
  return {{"uniform", uniform_density(0, 1), "-1/2"},
          {"x^3, good", power_density(3), "-1/2"},
          {"x^4, proportional", power_density(4), "no error at all", true},
          {"x^7, too far", power_density(7), "-1/2"},
          {"x^14, too thin", power_density(14), "-1/3"},
          {"uniform on [1/2, 1)", uniform_density(0.5, 1), "0: a bias of 1/32"}};
}

Curve curve_of(Notebook& notebook, const EstimatorWay& way) {
  Curve curve{way.name, {}};
  carlo::Rng rng = notebook.rng();
  for (const std::int64_t n : ladder(64, std::max<std::int64_t>(notebook.options().n / 16, 4096))) {
    curve.runs.push_back(repeat(n, repetitions(notebook, n), Summary::median, [&] {
      double sum = 0;
      for (const double y : contributions(power_f, way.p, n, rng))
        sum += y;
      return Trial{sum / static_cast<double>(n), power_integral};
    }));
  }
  return curve;
}

}  // namespace

void convergence_experiment(Notebook& notebook) {
  notebook.begin("Error against N and against time");
  std::vector<Curve> curves, drawn;
  carlo::Table slopes({"p", "theory", "against N", "against seconds", "final error", "time"},
                      {"p", "theory", "slope_points", "slope_seconds", "error", "seconds"});
  const bool done = notebook.attempt([&] {
    for (const EstimatorWay& way : convergence_ways()) {
      notebook.progress(static_cast<double>(curves.size()), 6);
      const Curve curve = curve_of(notebook, way);
      const Measurement& last = curve.runs.back();
      const auto fit = [&](bool seconds) {
        if (way.exact) return carlo::empty_cell();
        return slope_cell(seconds ? curve.against_seconds() : curve.against_points());
      };
      slopes.add_row({way.name, way.theory, fit(false), fit(true), last.error,
                      carlo::seconds_cell(last.seconds)});
      curves.push_back(curve);
      if (!way.exact) drawn.push_back(curve);
    }
  });
  if (!done) return;
  notebook.say(
      "The same integral with six densities; the error is the median of |estimate - 1|, which "
      "exists even where the variance does not. A better p lowers the line and keeps its slope. "
      "One that is too thin where f is not breaks the slope; one that is 0 where f is not has an "
      "error that no number of samples will mend. In the right-hand plot a p pays for its "
      "logarithms and powers.");
  notebook.table("convergence_slopes", slopes, "Slope of log error, with 95 % interval");
  notebook.numbers("convergence", measurement_table(curves, 2), "Median error of the estimates");
  notebook.charts(error_charts("Importance sampling", "median error", drawn));
}

}  // namespace lab06
