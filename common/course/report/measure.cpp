#include "course/report/measure.h"

#include "course/report/format.h"
#include "support/wall_clock.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace carlo {
namespace {

/// Estimates between two readings of the clock, which take about 30 ns each. The time per estimate
/// is the median over the batches, so that interruptions by other programs do not count.
constexpr int batch = 4;

double root_mean_square(const std::vector<double>& errors) {
  double sum = 0;
  for (const double e : errors)
    sum += e * e;
  return std::sqrt(sum / static_cast<double>(errors.size()));
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

std::optional<PowerFit> fit(const std::vector<Measurement>& runs, bool seconds) {
  std::vector<double> x, y;
  for (const Measurement& m : runs) {
    const double floor = 1e-12 * std::fabs(m.estimate);
    const double at = seconds ? m.seconds : static_cast<double>(m.points);
    if (!(std::isfinite(m.error) && m.error > floor && at > 0)) continue;
    x.push_back(at);
    y.push_back(m.error);
  }
  if (x.size() < 4) return std::nullopt;
  return fit_power_law(x, y);
}

Series series(const Curve& curve, bool seconds, bool fitted) {
  Series result{curve.name, {}};
  for (const Measurement& m : curve.runs) {
    result.points.push_back({seconds ? m.seconds : static_cast<double>(m.points), m.error});
  }
  if (fitted) result.fit = fit(curve.runs, seconds);
  return result;
}

}  // namespace

Measurement repeat(std::int64_t points, int repetitions, Summary summary,
                   const std::function<Trial()>& trial) {
  std::vector<double> errors;
  std::vector<double> times;
  Measurement result{points};
  while (static_cast<int>(errors.size()) < repetitions) {
    const WallClock clock;
    for (int i = 0; i < batch; ++i) {
      const Trial t = trial();
      result.estimate = t.estimate;
      errors.push_back(std::fabs(t.estimate - t.exact));
    }
    times.push_back(clock.seconds() / batch);
  }
  result.seconds = median(std::move(times));
  result.error = summary == Summary::median ? median(std::move(errors)) : root_mean_square(errors);
  return result;
}

Measurement time_rule(std::int64_t points, double exact, const std::function<double()>& rule) {
  Measurement result{points};
  std::vector<double> times;
  const WallClock all;
  do {
    const WallClock clock;
    for (int i = 0; i < batch; ++i)
      result.estimate = rule();
    times.push_back(clock.seconds() / batch);
  } while (all.seconds() < 2e-3);
  result.seconds = median(std::move(times));
  result.error = std::fabs(result.estimate - exact);
  return result;
}

double best_seconds(const std::function<double()>& work) {
  double best = std::numeric_limits<double>::infinity();
  for (int round = 0; round < 3; ++round) {
    const WallClock clock;
    [[maybe_unused]] volatile double sink = work();
    best = std::min(best, clock.seconds());
  }
  return best;
}

std::vector<std::int64_t> ladder(std::int64_t first, std::int64_t last) {
  std::vector<std::int64_t> rungs;
  for (std::int64_t n = first; n <= last; n *= 4)
    rungs.push_back(n);
  return rungs;
}

std::optional<PowerFit> Curve::against_points() const {
  return fit(runs, false);
}
std::optional<PowerFit> Curve::against_seconds() const {
  return fit(runs, true);
}

std::vector<Chart> error_charts(const std::string& title, const std::string& error_label,
                                const std::vector<Curve>& curves, bool fitted) {
  Chart points{title + ": error against points", "", {"points N", Unit::count}, {error_label}, {}};
  Chart seconds{title + ": error against time", "", {"time", Unit::seconds}, {error_label}, {}};
  for (const Curve& curve : curves) {
    points.series.push_back(series(curve, false, fitted));
    seconds.series.push_back(series(curve, true, fitted));
  }
  return {points, seconds};
}

Table measurement_table(const std::vector<Curve>& curves, std::size_t stride) {
  Table table({"method", "N", "estimate", "error", "time"},
              {"method", "points", "estimate", "error", "seconds"});
  for (const Curve& curve : curves) {
    for (std::size_t i = 0; i < curve.runs.size(); ++i) {
      if ((curve.runs.size() - 1 - i) % stride != 0) continue;
      const Measurement& m = curve.runs[i];
      table.add_row({curve.name, m.points, Cell(number_text(m.estimate, 7), m.estimate), m.error,
                     seconds_cell(m.seconds)});
    }
  }
  return table;
}

Cell slope_cell(const std::optional<PowerFit>& fit) {
  return fit ? interval_cell(fit->slope, fit->slope_half_width) : empty_cell();
}

Table slope_table(const std::vector<ExpectedCurve>& curves) {
  Table table({"method", "theory", "slope against N", "slope against time"},
              {"method", "theory", "slope_points", "slope_seconds"});
  for (const auto& [curve, slope] : curves) {
    table.add_row({curve.name, slope, slope_cell(curve.against_points()),
                   slope_cell(curve.against_seconds())});
  }
  return table;
}

std::vector<Curve> curves_of(const std::vector<ExpectedCurve>& expected) {
  std::vector<Curve> curves;
  curves.reserve(expected.size());
  for (const ExpectedCurve& e : expected)
    curves.push_back(e.curve);
  return curves;
}

}  // namespace carlo
