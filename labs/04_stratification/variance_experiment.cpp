#include "course/report/format.h"
#include "experiments.h"

#include <fmt/core.h>

#include <cmath>

// Error bars with strata: the variance before and after, and whether the bars are honest.

namespace lab04 {
namespace {

constexpr std::int64_t points = 4096;

struct Found {
  StratifiedEstimate one;    ///< a single run
  double squared_error = 0;  ///< measured, over all runs
  double claimed = 0;        ///< mean squared standard error
  double plain = 0;          ///< mean squared plain standard error
  double covered = 0;        ///< fraction of value -+ 1.96 standard errors that hold the truth
  double seconds = 0;
};

Found measure(const Integrand& g, std::int64_t side, int repetitions, carlo::Rng& rng) {
  const auto estimate = [&] {
    return stratified_estimate(g.f, side, side, points / (side * side), rng);
  };
  Found found;
  for (int i = 0; i < repetitions; ++i) {
    found.one = estimate();
    const double off = found.one.value - g.average, bar = found.one.standard_error;
    found.squared_error += off * off / repetitions;
    found.claimed += bar * bar / repetitions;
    found.plain += std::pow(found.one.plain_standard_error, 2) / repetitions;
    found.covered += std::fabs(off) <= 1.96 * bar ? 1.0 / repetitions : 0;
  }
  found.seconds = carlo::time_rule(points, g.average, [&] { return estimate().value; }).seconds;
  return found;
}

}  // namespace

void variance_experiment(Notebook& notebook) {
  notebook.begin("The variance before and after");
  carlo::Table table({"integrand", "cells", "one estimate", "before", "after", "gain", "true error",
                      "covered", "time"},
                     {"integrand", "cells", "estimate", "plain_error", "error", "gain",
                      "true_error", "covered", "seconds"});
  const int repetitions = notebook.repetitions(400);
  carlo::Chart chart{"What strata save",
                     "4096 points, shared out evenly",
                     {"cells", carlo::Unit::count},
                     {"variance before / after"},
                     {}};
  notebook.attempt([&] {
    double step = 0;
    for (const Integrand& g : {bell(), darts()}) {
      carlo::Series series{g.name, {}};
      for (const std::int64_t side : {1, 2, 4, 8, 16, 32}) {
        notebook.progress(step++, 12);
        carlo::Rng rng = notebook.rng();
        const Found f = measure(g, side, repetitions, rng);
        const double gain = f.plain / f.claimed;
        series.points.push_back({static_cast<double>(side * side), gain});
        table.add_row(
            {g.name, side * side, carlo::interval_cell(f.one.value, 1.96 * f.one.standard_error),
             std::sqrt(f.plain), std::sqrt(f.claimed),
             carlo::Cell(carlo::number_text(gain, 3) + "×", gain), std::sqrt(f.squared_error),
             carlo::Cell(fmt::format("{:.1f} %", 100 * f.covered), f.covered),
             carlo::seconds_cell(f.seconds)});
      }
      chart.series.push_back(std::move(series));
    }
    notebook.say(
        "4096 points shared out over more and more cells. \"Before\" is the standard error that as "
        "many points without strata would have, \"after\" the one with strata; both come from the "
        "same values of f, so a renderer could tell while it runs what its strata are worth. The "
        "true error is measured over repeated estimates; of the intervals value ± 1.96 standard "
        "errors 95 % should hold the exact value.");
    notebook.table("variance", table, "Standard errors without and with strata, 4096 points");
    notebook.charts({chart});
  });
}

}  // namespace lab04
