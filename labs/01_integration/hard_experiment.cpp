#include "experiments.h"
#include "integrands.h"
#include "support/wall_clock.h"

#include <fmt/core.h>

#include <array>
#include <cmath>

// Badly behaved integrands: what happens to the slopes, and how far the error bars can be trusted.

namespace lab01 {
namespace {

constexpr double spike_width = 1e-3;

/// A hard integrand; jump and spike move to a new random place in every repetition, since a grid's
/// error depends on where they are.
struct Hard {
  std::string name;
  std::function<Integrand(carlo::Rng&)> make;
  const char* variance;
  const char* slope;       ///< of Monte Carlo's error, in theory
  const char* rule_slope;  ///< of the midpoint rule's error
};

std::vector<Hard> hard_integrands() {
  const auto fixed = [](const Integrand& g) { return [g](carlo::Rng&) { return g; }; };
  return {
      {"jump", [](carlo::Rng& rng) { return jump(0.25 + 0.5 * rng.uniform()); }, "finite", "-1/2",
       "-1"},
      {"x^-1/4", fixed(singular(0.25)), "finite", "-1/2", "-3/4"},
      {"x^-1/2", fixed(singular(0.5)), "infinite, just", "-1/2 (√(log N / N))", "-1/2"},
      {"x^-3/4", fixed(singular(0.75)), "infinite", "-1/4", "-1/4"},
      {"rare spike", [](carlo::Rng& rng) { return spike(spike_width, 0.9 * rng.uniform()); },
       "finite, 999", "-1/2, once found", "none until h < width"},
  };
}

/// estimate(g, n, rng) uses n evaluations of the integrand g.
template <class Estimate>
Curve hard_curve(Notebook& notebook, const Hard& hard, const std::vector<std::int64_t>& rungs,
                 const Estimate& estimate) {
  Curve curve{hard.name, {}};
  carlo::Rng rng = notebook.rng();
  for (const std::int64_t n : rungs) {
    const auto trial = [&] {
      const Integrand g = hard.make(rng);
      return Trial{estimate(g, n, rng) / g.integral, 1};
    };
    curve.runs.push_back(repeat(n, notebook.repetitions(128), Summary::median, trial));
  }
  return curve;
}

double by_dice(const Integrand& g, std::int64_t n, carlo::Rng& rng) {
  return integrate(g.f, g.a, g.b, n, rng);
}

double by_midpoints(const Integrand& g, std::int64_t n, carlo::Rng&) {
  return midpoint(g.f, g.a, g.b, n);
}

/// The fraction of `repetitions` intervals mean -+ 1.96 standard errors that hold the integral.
struct Coverage {
  double share = 0;
  double seconds = 0;  ///< per interval
};

Coverage coverage(const Hard& hard, std::int64_t n, int repetitions, carlo::Rng& rng) {
  int held = 0;
  const carlo::WallClock clock;
  // slide: coverage
  for (int i = 0; i < repetitions; ++i) {
    const Integrand g = hard.make(rng);
    Moments values;
    for (std::int64_t k = 0; k < n; ++k)
      values.add(g.f(rng.uniform()));
    const double error = std::fabs(values.mean() - g.integral);
    if (error <= 1.96 * values.standard_error()) ++held;
  }
  // end slide
  return {static_cast<double>(held) / repetitions, clock.seconds() / repetitions};
}

carlo::Table coverage_table(Notebook& notebook, const std::vector<Hard>& all) {
  constexpr std::array<std::int64_t, 3> sizes = {100, 1000, 10000};
  const int repetitions = notebook.repetitions(400);
  carlo::Table table(
      {"integrand", "variance", "N = 100", "N = 1000", "N = 10 000", "time at 10 000"},
      {"integrand", "variance", "covered_100", "covered_1000", "covered_10000", "seconds_10000"});
  carlo::Rng rng = notebook.rng();
  for (const Hard& hard : all) {
    std::vector<carlo::Cell> row = {hard.name, hard.variance};
    Coverage last;
    for (const std::int64_t n : sizes) {
      last = coverage(hard, n, repetitions, rng);
      row.emplace_back(fmt::format("{:.1f} %", 100 * last.share), last.share);
    }
    row.push_back(carlo::seconds_cell(last.seconds));
    table.add_row(std::move(row));
  }
  return table;
}

carlo::Table slope_table(const std::vector<Hard>& all, const std::vector<Curve>& dice,
                         const std::vector<Curve>& rules) {
  carlo::Table table({"integrand", "theory", "Monte Carlo", "theory, rule", "midpoint"},
                     {"integrand", "theory_monte_carlo", "slope_monte_carlo", "theory_midpoint",
                      "slope_midpoint"});
  for (std::size_t i = 0; i < all.size(); ++i) {
    // A spike that no point has hit yet leaves a flat line, not a slope.
    const bool fitted = all[i].name != "rare spike";
    const auto cell = [&](const std::vector<Curve>& curves) {
      return i < curves.size() && fitted ? slope_cell(curves[i].against_points())
                                         : carlo::empty_cell();
    };
    table.add_row({all[i].name, all[i].slope, cell(dice), all[i].rule_slope, cell(rules)});
  }
  return table;
}

}  // namespace

void hard_integrands_experiment(Notebook& notebook) {
  notebook.begin("Badly behaved integrands");
  const std::vector<Hard> all = hard_integrands();
  const auto rungs = ladder(16, notebook.options().n / 4);
  std::vector<Curve> dice, rules;
  double step = 0;
  const auto advance = [&] { notebook.progress(step++, 3.0 * static_cast<double>(all.size())); };
  notebook.attempt([&] {
    for (const Hard& hard : all) {
      advance();
      dice.push_back(hard_curve(notebook, hard, rungs, by_dice));
    }
  });
  notebook.attempt([&] {
    for (const Hard& hard : all) {
      advance();
      rules.push_back(hard_curve(notebook, hard, rungs, by_midpoints));
    }
  });
  notebook.say(
      "A shadow's edge, three integrable singularities at 0 and a spike that holds half of the "
      "integral on a thousandth of the interval. Estimates are relative to the exact value, and "
      "the error is the median of |estimate - 1|: where the variance is infinite a root mean "
      "square would never settle.");
  if (!dice.empty() || !rules.empty()) {
    notebook.table("hard_slopes", slope_table(all, dice, rules),
                   "Slope of log error against N, with 95 % interval");
    notebook.table("hard", measurement_table(dice, 3), "Monte Carlo, relative to the exact value");
    if (!dice.empty()) {
      notebook.charts(error_charts("Monte Carlo", "median relative error", dice, false));
    }
    if (!rules.empty()) {
      notebook.charts(error_charts("Midpoint rule", "median relative error", rules, false));
    }
  }
  notebook.attempt([&] {
    advance();
    const carlo::Table table = coverage_table(notebook, all);
    notebook.say(
        "Error bars are estimates too. Of all intervals mean ± 1.96 standard errors 95 % should "
        "hold the exact value. A spike that was not met leaves a small variance and a confident, "
        "wrong answer; where the true variance is infinite, the bars have nothing to estimate.");
    notebook.table("hard_coverage", table, "Intervals that hold the exact value");
  });
}

}  // namespace lab01
