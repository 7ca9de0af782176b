#include "course/viewer/tiles.h"
#include "experiments.h"
#include "importance.h"
#include "pictures.h"
#include "power_family.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <vector>

// A density too thin in the tails: how it shows, and how it is cured.

namespace lab06 {
namespace {

constexpr double thin = 14, share = 0.9;
constexpr double first_shown = 64;  ///< of the running means

/// The cure: nine draws in ten come from the thin density, one from the uniform one.
Density defended() {
  return mixture(power_density(thin), uniform_density(0, 1), share);
}

/// The mean of the first N contributions against N, with both ends of every jump.
Line running_mean(const std::string& name, const std::string& style,
                  const std::vector<double>& values) {
  Line result{name, style, {}};
  double sum = 0, next = first_shown;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const auto n = static_cast<double>(i + 1);
    const double before = sum / std::max(1.0, n - 1);
    sum += values[i];
    const bool jump = n > first_shown && std::abs(sum / n - before) > 0.003;
    if (jump) result.points.push_back({n - 1, before});
    if (jump || n >= next) result.points.push_back({n, sum / n});
    if (n >= next) next *= 1.02;
  }
  return result;
}

std::string running_picture(Notebook& notebook, std::string_view title, std::string_view note,
                            const Density& p) {
  const std::int64_t n = notebook.options().n;
  const View view{first_shown, static_cast<double>(n), 1.4, 0.6, carlo::Scale::log};
  std::vector<Line> runs;
  for (int run = 1; run <= 4; ++run) {
    carlo::Rng rng = notebook.rng();
    runs.push_back(running_mean(fmt::format("run {}", run), fmt::format("c{}", run),
                                contributions(power_f, p, n, rng)));
  }
  return graph_picture(title, note, view, runs);
}

void running_pictures(Notebook& notebook) {
  std::vector<std::string> pictures;
  pictures.push_back(running_picture(notebook, "p as x^14: too thin",
                                     "the mean of the first N, logarithmic in N; the integral is 1",
                                     power_density(thin)));
  pictures.push_back(running_picture(notebook, "p uniform",
                                     "the same scale: noise that settles, without jumps",
                                     uniform_density(0, 1)));
  notebook.raw_html(carlo::tiles(pictures, 24));
}

/// A density and its theoretical properties.
struct Suspect {
  std::string name;
  Density p;
  double index;
};

carlo::Cell index_cell(double index) {
  return std::isfinite(index) ? carlo::Cell(index) : carlo::Cell("none", index);
}

carlo::Table symptoms(Notebook& notebook, const std::vector<Suspect>& suspects) {
  const std::int64_t n = notebook.options().n;
  const auto k = static_cast<std::size_t>(std::sqrt(static_cast<double>(n)));
  carlo::Table table({"p", "tail index", fmt::format("Hill, k = {}", k), "variance",
                      "largest share", "estimate", "standard error", "off by"},
                     {"p", "index", "hill", "variance", "largest_share", "estimate",
                      "standard_error", "errors_off"});
  for (const Suspect& suspect : suspects) {
    carlo::Rng rng = notebook.rng();
    const auto values = contributions(power_f, suspect.p, n, rng);
    const Estimate e = summarize(values);
    const double hill = tail_index(values, k);
    const double off = (e.value - power_integral) / e.standard_error;
    table.add_row(
        {suspect.name, index_cell(suspect.index),
         hill > 20 ? carlo::Cell("above 20", hill)
                   : carlo::interval_cell(hill, 1.96 * hill / std::sqrt(static_cast<double>(k))),
         suspect.index > 2 ? "finite" : "infinite", largest_share(values), e.value,
         e.standard_error, carlo::Cell(fmt::format("{:+.1f} se", off), off)});
  }
  return table;
}

std::vector<Suspect> suspects() {
  std::vector<Suspect> all = {{"uniform", uniform_density(0, 1), power_tail_index(0)}};
  for (const double n : {3.0, 7.0, 8.5, 11.0, thin})
    all.push_back({fmt::format("x^{:g}", n), power_density(n), power_tail_index(n)});
  return all;
}

/// The largest sample's share against N, the median over repetitions.
Curve share_curve(Notebook& notebook, const Suspect& suspect) {
  Curve curve{suspect.name, {}};
  carlo::Rng rng = notebook.rng();
  for (const std::int64_t n : ladder(64, std::max<std::int64_t>(notebook.options().n / 16, 1024))) {
    curve.runs.push_back(repeat(n, notebook.repetitions(128), Summary::median, [&] {
      return Trial{largest_share(contributions(power_f, suspect.p, n, rng)), 0};
    }));
  }
  return curve;
}

Curve error_curve(Notebook& notebook, const std::string& name, const Density& p) {
  Curve curve{name, {}};
  carlo::Rng rng = notebook.rng();
  for (const std::int64_t n : ladder(64, std::max<std::int64_t>(notebook.options().n / 16, 1024))) {
    curve.runs.push_back(repeat(n, repetitions(notebook, n), Summary::median, [&] {
      return Trial{summarize(contributions(power_f, p, n, rng)).value, power_integral};
    }));
  }
  return curve;
}

void share_chart(Notebook& notebook) {
  carlo::Chart chart{
      "The largest sample's share of the sum",
      "as N^(-1 + 1/index): the heavier the tail, the longer single samples rule the sum",
      {"samples N", carlo::Unit::count},
      {"share, median"},
      {}};
  for (const Suspect& suspect : suspects()) {
    const Curve curve = share_curve(notebook, suspect);
    carlo::Series series{curve.name, {}};
    for (const Measurement& m : curve.runs)
      series.points.push_back({static_cast<double>(m.points), m.error});
    series.fit = curve.against_points();
    chart.series.push_back(series);
  }
  notebook.charts({chart});
}

void cure(Notebook& notebook) {
  std::vector<Curve> curves;
  curves.push_back(error_curve(notebook, "x^14 alone", power_density(thin)));
  curves.push_back(error_curve(notebook, "with 10 % uniform", defended()));
  curves.push_back(error_curve(notebook, "uniform alone", uniform_density(0, 1)));
  notebook.say(
      "The cure costs one draw in ten. In the mixture 0.9 p + 0.1 uniform no contribution can be "
      "larger than ten times f, whatever p does: the tail is cut, the slope is -1/2 again.");
  carlo::Table table({"p", "theory", "against N", "final error", "time"},
                     {"p", "theory", "slope_points", "error", "seconds"});
  const char* const theory[] = {"-1/3", "-1/2", "-1/2"};
  for (std::size_t i = 0; i < curves.size(); ++i) {
    const Measurement& last = curves[i].runs.back();
    table.add_row({curves[i].name, theory[i], slope_cell(curves[i].against_points()), last.error,
                   carlo::seconds_cell(last.seconds)});
  }
  notebook.table("defended", table, "Slope of log error against N, with 95 % interval");
  notebook.table("defended_symptoms",
                 symptoms(notebook, {{"0.9 x^14 + 0.1 uniform", defended(), power_tail_index(0)}}),
                 "The symptoms after the cure");
  notebook.charts(error_charts("Defended", "median error", curves));
}

}  // namespace

void tails_experiment(Notebook& notebook) {
  notebook.begin("Too thin in the tails");
  notebook.say(
      "With p as x^14 the region near 0 holds next to no samples, though f is not that small "
      "there; the few that land have huge f/p. The estimator is unbiased, yet most runs are too "
      "low, and the standard error, estimated from the same samples, is too small with them.");
  notebook.attempt([&] { running_pictures(notebook); });
  notebook.progress(1, 4);
  notebook.attempt([&] {
    const carlo::Table table = symptoms(notebook, suspects());
    notebook.say(
        "Three symptoms that need no exact value: a tail index at or below 2, one sample that "
        "holds a visible share of the whole sum, and a share that hardly falls as N grows.");
    notebook.table("symptoms", table, "What the samples themselves tell");
  });
  notebook.progress(2, 4);
  notebook.attempt([&] { share_chart(notebook); });
  notebook.progress(3, 4);
  notebook.attempt([&] { cure(notebook); });
}

}  // namespace lab06
