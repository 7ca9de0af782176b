#include "course/report/format.h"
#include "experiments.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

// Five point sets, a smooth integrand and one with an edge; pi by darts with strata.

namespace lab04 {
namespace {

Curve curve(Notebook& notebook, const PointSet& set, const Integrand& integrand) {
  Curve result{set.name, {}};
  carlo::Rng rng = notebook.rng();
  for (const std::int64_t n : ladder(16, notebook.options().n)) {
    const auto trial = [&] {
      return Trial{average_over(set.make(n, rng), integrand), integrand.average};
    };
    result.runs.push_back(repeat(n, notebook.repetitions(160), Summary::root_mean_square, trial));
  }
  return result;
}

std::vector<ExpectedCurve> curves(Notebook& notebook, const Integrand& integrand, bool smooth) {
  std::vector<ExpectedCurve> result;
  double step = smooth ? 0 : 5;
  for (const PointSet& set : all_point_sets()) {
    notebook.progress(step++, 10);
    notebook.attempt([&] {
      result.push_back(
          {curve(notebook, set, integrand), smooth ? set.smooth_slope : set.edge_slope});
    });
  }
  return result;
}

void report(Notebook& notebook, const std::string& key, const Integrand& integrand,
            const std::vector<ExpectedCurve>& found) {
  notebook.table(key + "_slopes", slope_table(found),
                 fmt::format("{}: slope of log error, with 95 % interval", integrand.name));
  notebook.table(key, measurement_table(curves_of(found), 3), integrand.name);
  notebook.charts(error_charts(integrand.name, "RMS error", curves_of(found)));
  notebook.data(key + "_all", measurement_table(curves_of(found)),
                integrand.name + ": all measurements");
}

/// A count to two significant digits.
std::int64_t rounded(double count) {
  const double unit = std::pow(10.0, std::max(0.0, std::floor(std::log10(count)) - 1));
  return std::llround(count / unit) * std::llround(unit);
}

/// Darts at pi, plain and jittered, and the number of plain darts that equal the strata.
void pi_table(Notebook& notebook, const Curve& plain, const Curve& strata) {
  carlo::Table table(
      {"N", "plain π", "RMS error", "π with strata", "RMS error", "worth plain darts"},
      {"points", "plain", "plain_error", "strata", "strata_error", "worth"});
  for (std::size_t i = 0; i < plain.runs.size() && i < strata.runs.size(); ++i) {
    const Measurement &a = plain.runs[i], &b = strata.runs[i];
    const double ratio = a.error / b.error;
    const double worth = ratio * ratio * static_cast<double>(a.points);
    table.add_row({a.points, carlo::number_cell(a.estimate, 6), a.error,
                   carlo::number_cell(b.estimate, 6), b.error,
                   carlo::Cell(carlo::count_text(rounded(worth)), worth)});
  }
  notebook.table("pi", table, "π by N darts: anywhere, and one in each of N cells");
}

}  // namespace

void slopes_experiment(Notebook& notebook) {
  notebook.begin("Slopes in two dimensions, and π with strata");
  notebook.say(
      "The average of exp(-x² - y²) over the unit square, and of 4 inside a quarter disc, which is "
      "π. Error against N, as a root mean square over repeated estimates, and against the seconds "
      "that one of them takes, the points included.");
  const Integrand smooth = bell(), edge = darts();
  report(notebook, "smooth", smooth, curves(notebook, smooth, true));
  const std::vector<ExpectedCurve> found = curves(notebook, edge, false);
  report(notebook, "edge", edge, found);
  if (found.size() > 1 && found[1].curve.name == "jittered") {
    pi_table(notebook, found[0].curve, found[1].curve);
  }
}

}  // namespace lab04
