#include "experiments.h"
#include "pi.h"

#include <cmath>
#include <functional>
#include <numbers>
#include <optional>

// The three estimators, and fast darts: slope, constant and cost.

namespace lab02 {
namespace {

using std::numbers::pi;

struct Method {
  std::string name;
  std::function<double(std::int64_t n, carlo::Rng& rng)> estimate;
  double (*deviation)();  ///< in theory
};

double by_darts(std::int64_t n, carlo::Rng& rng) {
  return pi_estimate(throw_darts(n, rng)).value;
}
double by_circle(std::int64_t n, carlo::Rng& rng) {
  return mean_of(sum_circle(n, rng)).value;
}
double by_arctangent(std::int64_t n, carlo::Rng& rng) {
  return mean_of(sum_arctangent(n, rng)).value;
}
double by_fast_darts(std::int64_t n, carlo::Rng& rng) {
  const auto hits = static_cast<double>(count_hits(rng.next_u64(), 0, n));
  return 4 * hits / static_cast<double>(n);
}

/// The results of one method.
struct Result {
  Method method;
  Curve curve;
  std::optional<double> theory;  ///< the variance of a sample, by Lab 2.4

  /// The variance of one sample: N times the mean square error, averaged over all N.
  double variance() const {
    double sum = 0;
    for (const Measurement& m : curve.runs)
      sum += static_cast<double>(m.points) * m.error * m.error;
    return sum / static_cast<double>(curve.runs.size());
  }
  /// Per sample, where a run is long enough for its start not to matter.
  double seconds() const {
    const Measurement& last = curve.runs.back();
    return last.seconds / static_cast<double>(last.points);
  }
};

Result measure(Notebook& notebook, const Method& method) {
  Result result{method, {method.name, {}}, std::nullopt};
  carlo::Rng rng = notebook.rng();
  const auto ns = ladder(64, notebook.options().n);
  for (const std::int64_t n : ns) {
    const auto trial = [&] { return Trial{method.estimate(n, rng), pi}; };
    result.curve.runs.push_back(
        repeat(n, notebook.repetitions(256), Summary::root_mean_square, trial));
  }
  notebook.attempt([&] {
    const double deviation = method.deviation();
    result.theory = deviation * deviation;
  });
  return result;
}

std::vector<Result> measure_all(Notebook& notebook) {
  const std::vector<Method> methods = {{"darts", by_darts, darts_deviation},
                                       {"4 √(1 − x²)", by_circle, circle_deviation},
                                       {"4 / (1 + x²)", by_arctangent, arctangent_deviation},
                                       {"fast darts", by_fast_darts, darts_deviation}};
  std::vector<Result> results;
  for (std::size_t i = 0; i < methods.size(); ++i) {
    notebook.progress(static_cast<double>(i), static_cast<double>(methods.size()));
    notebook.attempt([&] { results.push_back(measure(notebook, methods[i])); });
  }
  return results;
}

/// Variance estimates from `runs` errors scatter by sqrt(2 / runs) of the variance.
double variance_half_width(double variance, double runs) {
  return z95 * variance * std::sqrt(2 / runs);
}

carlo::Table summary_table(const std::vector<Result>& results, double runs) {
  carlo::Table table(
      {"method", "variance on paper", "measured", "time a sample", "efficiency", "slope in N",
       "slope in time"},
      {"method", "variance_theory", "variance", "seconds", "efficiency", "slope", "slope_seconds"});
  for (const Result& r : results) {
    const double errors = runs * static_cast<double>(r.curve.runs.size());
    const double efficiency = 1 / (r.variance() * r.seconds());
    table.add_row({r.method.name, r.theory ? carlo::Cell(*r.theory) : carlo::empty_cell(),
                   carlo::interval_cell(r.variance(), variance_half_width(r.variance(), errors)),
                   carlo::seconds_cell(r.seconds()), carlo::number_cell(efficiency),
                   carlo::slope_cell(r.curve.against_points()),
                   carlo::slope_cell(r.curve.against_seconds())});
  }
  return table;
}

carlo::Chart variance_chart(const std::vector<Result>& results) {
  carlo::Chart chart{"N × variance of the estimate",
                     "a level line: the variance falls as 1/N",
                     {"samples N", carlo::Unit::count},
                     {"N × variance"},
                     {}};
  for (const Result& r : results) {
    carlo::Series measured{r.method.name, {}};
    for (const Measurement& m : r.curve.runs) {
      const auto n = static_cast<double>(m.points);
      measured.points.push_back({n, n * m.error * m.error});
    }
    chart.series.push_back(measured);
  }
  for (const Result& r : results) {
    if (!r.theory || r.method.name == "fast darts") continue;  // both kinds of darts share one
    carlo::Series paper{r.method.name + ", on paper", {}};
    for (const Measurement& m : r.curve.runs)
      paper.points.push_back({static_cast<double>(m.points), *r.theory});
    chart.series.push_back(paper);
  }
  return chart;
}

carlo::Table planning_table(const std::vector<Result>& results) {
  carlo::Table table({"method", "half width", "N needed", "time it takes"},
                     {"method", "half_width", "points", "seconds"});
  for (const Result& r : results) {
    for (const double half_width : {1e-2, 1e-3, 1e-4, 1e-5}) {
      const std::int64_t n = samples_needed(r.method.deviation(), half_width, z95);
      table.add_row({r.method.name, half_width, n,
                     carlo::seconds_cell(r.seconds() * static_cast<double>(n))});
    }
  }
  return table;
}

}  // namespace

void estimators_experiment(Notebook& notebook) {
  notebook.begin("Three estimators, and what they are worth");
  notebook.attempt([] { (void)samples_needed(1, 1, 1); });
  const std::vector<Result> results = measure_all(notebook);
  if (results.empty()) return;
  std::vector<Curve> curves;
  for (const Result& r : results)
    curves.push_back(r.curve);
  notebook.say(
      "All are unbiased, all have slope -1/2. The constants differ: the variance of one sample and "
      "the time it takes. What counts is the product. Efficiency is 1/(variance × time), and an "
      "estimator of twice the efficiency reaches the same error in half the time.");
  notebook.table("estimators", summary_table(results, notebook.repetitions(256)),
                 "Variance and time of one sample");
  notebook.charts(error_charts("π", "RMS error", curves));
  notebook.charts({variance_chart(results)});
  notebook.table("errors", measurement_table(curves, 3), "RMS error of repeated estimates");
  notebook.attempt([&] {
    const carlo::Table plan = planning_table(results);
    notebook.table("planning", plan, "What 95 % within half a width takes (Lab 2.4)");
  });
}

}  // namespace lab02
