#include "experiments.h"

#include <cmath>
#include <functional>

// Strata on the line, beside plain random points.

namespace lab04 {

namespace {

double plain_average(const Function& f, std::int64_t n, carlo::Rng& rng) {
  double sum = 0;
  for (std::int64_t i = 0; i < n; ++i)
    sum += f(rng.uniform());
  return sum / static_cast<double>(n);
}

using LineMethod = double (*)(const Function&, std::int64_t, carlo::Rng&);

/// A fresh integrand for each estimate, and its exact average.
struct Drawn {
  Function f;
  double average;
};

Curve curve(Notebook& notebook, const std::string& name, LineMethod method,
            const std::function<Drawn(carlo::Rng&)>& integrand) {
  Curve result{name, {}};
  carlo::Rng rng = notebook.rng();
  for (const std::int64_t n : ladder(16, notebook.options().n)) {
    const auto trial = [&] {
      const Drawn g = integrand(rng);
      return Trial{method(g.f, n, rng), g.average};
    };
    result.runs.push_back(repeat(n, notebook.repetitions(128), Summary::root_mean_square, trial));
  }
  return result;
}

}  // namespace

void line_experiment(Notebook& notebook) {
  notebook.begin("Strata on the line");
  const auto smooth = [](carlo::Rng&) {
    return Drawn{[](double x) { return std::exp(x); }, std::expm1(1.0)};
  };
  // An edge at a fixed place could fall on a boundary of strata.
  const auto jump = [](carlo::Rng& rng) {
    const double edge = rng.uniform();
    return Drawn{[edge](double x) { return x < edge ? 1.0 : 0.0; }, edge};
  };
  std::vector<ExpectedCurve> curves = {
      {curve(notebook, "exp(x), random", plain_average, smooth), "-1/2"},
      {curve(notebook, "a jump, random", plain_average, jump), "-1/2"}};
  notebook.progress(1, 2);
  notebook.attempt([&] {
    curves.push_back({curve(notebook, "exp(x), strata", stratified_average, smooth), "-3/2"});
    curves.push_back({curve(notebook, "a jump, strata", stratified_average, jump), "-1"});
  });
  notebook.say(
      "The average over [0, 1) of exp(x), and of a function that jumps at a random place, from N "
      "random points and from one point in each of N strata. Errors are root mean squares. Within "
      "a stratum of width 1/N a smooth function varies by about 1/N: a standard deviation of 1/N a "
      "point, and the N points' errors are independent. A jump lies in one stratum only.");
  notebook.table("line", measurement_table(curves_of(curves), 3), "Averages on [0, 1)");
  notebook.table("line_slopes", slope_table(curves), "Slope of log error, with 95 % interval");
  notebook.charts(error_charts("Averages on [0, 1)", "RMS error", curves_of(curves)));
  notebook.data("line_all", measurement_table(curves_of(curves)), "All measurements");
}

}  // namespace lab04
