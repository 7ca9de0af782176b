#include "course/report/format.h"
#include "experiments.h"
#include "pi.h"
#include "support/wall_clock.h"

#include <fmt/core.h>

#include <functional>
#include <numbers>

// How often 95 % intervals hold the truth: the score interval, and the one whose width comes from
// the measured share.

namespace lab02 {
namespace {

/// Something that hits with probability p.
struct Target {
  std::string name;
  double p;
  std::function<Darts(std::int64_t n, carlo::Rng& rng)> shoot;
  std::vector<std::int64_t> sizes;
};

Darts shoot_at_share(double p, std::int64_t n, carlo::Rng& rng) {
  Darts darts{n, 0};
  for (std::int64_t i = 0; i < n; ++i)
    darts.hits += rng.uniform() < p ? 1 : 0;
  return darts;
}

std::vector<Target> targets(bool quick) {
  const auto rare = [](std::int64_t n, carlo::Rng& rng) { return shoot_at_share(0.01, n, rng); };
  std::vector<std::int64_t> sizes = {3, 10, 30, 100, 1000};
  if (!quick) sizes.push_back(10'000);
  return {{"quarter disc", std::numbers::pi / 4, throw_darts, sizes},
          {"a target of 1 %", 0.01, rare, {10, 100, 1000}}};
}

/// The results of one kind of interval.
struct Tally {
  std::int64_t held = 0;
  double width = 0;

  void add(const Interval& interval, double truth) {
    held += interval.lower <= truth && truth <= interval.upper ? 1 : 0;
    width += interval.upper - interval.lower;
  }
};

Interval normal_interval(const Darts& darts) {
  const Estimate e = pi_estimate(darts);
  return {e.value - z95 * e.standard_error, e.value + z95 * e.standard_error};
}

struct Outcome {
  Tally normal, score;
  double seconds = 0;
};

Outcome run(const Target& target, std::int64_t n, int runs, carlo::Rng rng) {
  Outcome outcome;
  const double truth = 4 * target.p;
  const carlo::WallClock clock;
  for (int i = 0; i < runs; ++i) {
    const Darts darts = target.shoot(n, rng);
    outcome.normal.add(normal_interval(darts), truth);
    outcome.score.add(pi_interval(darts, z95), truth);
  }
  outcome.seconds = clock.seconds();
  return outcome;
}

carlo::Cell percent(std::int64_t held, int runs) {
  const double share = static_cast<double>(held) / runs;
  return {fmt::format("{:.2f} %", 100 * share), share};
}

}  // namespace

void coverage_experiment(Notebook& notebook) {
  notebook.begin("Do the intervals keep their promise?");
  const int runs = notebook.repetitions(10'000);
  carlo::Table table({"target", "N", "estimate ± 1.96 s.e.", "its width", "score interval",
                      "score's width", "time"},
                     {"target", "points", "normal_coverage", "normal_width", "score_coverage",
                      "score_width", "seconds"});
  if (!notebook.attempt([] { (void)pi_interval({1, 1}, z95); })) return;
  std::vector<carlo::Chart> charts;
  const bool done = notebook.attempt([&] {
    carlo::Chart chart{
        "Share of 95 % intervals that hold π",
        fmt::format("of {} runs each", carlo::count_text(runs)),
        {"darts N", carlo::Unit::count},
        {"share", carlo::Unit::number, carlo::Scale::linear},
        {{"estimate ± 1.96 standard errors", {}}, {"score interval", {}}, {"95 %", {}}}};
    for (const Target& target : targets(notebook.options().quick)) {
      for (const std::int64_t n : target.sizes) {
        const Outcome o = run(target, n, runs, notebook.rng());
        table.add_row({target.name, n, percent(o.normal.held, runs), o.normal.width / runs,
                       percent(o.score.held, runs), o.score.width / runs,
                       carlo::seconds_cell(o.seconds / runs)});
        notebook.progress(static_cast<double>(table.rows().size()), 9);
        if (target.p < 0.5) continue;
        const auto x = static_cast<double>(n);
        chart.series[0].points.push_back({x, static_cast<double>(o.normal.held) / runs});
        chart.series[1].points.push_back({x, static_cast<double>(o.score.held) / runs});
        chart.series[2].points.push_back({x, 0.95});
      }
    }
    charts.push_back(chart);
  });
  if (!done) return;
  notebook.say(
      "An interval of 95 % is a promise about a procedure: in 95 of 100 runs it holds the truth. "
      "The estimate ± 1.96 standard errors takes its width from the hits, and with few hits, "
      "or few misses, it is too sure of itself; with none its width is 0. The score interval takes "
      "the width that belongs to each candidate value. Neither can be exact for every N, because "
      "the count of hits is a whole number.");
  notebook.table("coverage", table,
                 fmt::format("{} runs each: intervals that hold the true value, and their mean "
                             "width",
                             carlo::count_text(runs)));
  notebook.charts(charts);
}

}  // namespace lab02
