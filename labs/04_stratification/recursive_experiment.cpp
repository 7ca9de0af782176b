#include "course/report/format.h"
#include "course/viewer/tiles.h"
#include "experiments.h"
#include "pictures.h"

#include <fmt/core.h>

// Strata that adapt: where they go, and what they gain.

namespace lab04 {
namespace {

FunctionNd on_cube(const Integrand& g) {
  return [f = g.f](std::span<const double> x) { return f(x[0], x[1]); };
}

Curve recursive_curve(Notebook& notebook, const Integrand& g) {
  Curve result{"recursive", {}};
  const FunctionNd f = on_cube(g);
  carlo::Rng rng = notebook.rng();
  for (const std::int64_t n : ladder(64, notebook.options().n)) {
    const auto trial = [&] {
      return Trial{recursive_stratification(f, 2, n, rng).value, g.average};
    };
    result.runs.push_back(repeat(n, notebook.repetitions(128), Summary::root_mean_square, trial));
  }
  return result;
}

Curve fixed_curve(Notebook& notebook, const PointSet& set, const Integrand& g) {
  Curve result{set.name, {}};
  carlo::Rng rng = notebook.rng();
  for (const std::int64_t n : ladder(64, notebook.options().n)) {
    const auto trial = [&] { return Trial{average_over(set.make(n, rng), g), g.average}; };
    result.runs.push_back(repeat(n, notebook.repetitions(128), Summary::root_mean_square, trial));
  }
  return result;
}

std::string picture(Notebook& notebook, const Integrand& g, std::int64_t n, Background under) {
  carlo::Rng rng = notebook.rng();
  std::vector<Stratum> strata;
  recursive_stratification(on_cube(g), 2, n, rng, &strata);
  return strata_picture(fmt::format("{}, n = {}", g.name, carlo::count_text(n)),
                        fmt::format("{} strata; darker: denser points", strata.size()), strata,
                        under);
}

void compare(Notebook& notebook, const std::string& key, const Integrand& g) {
  const std::vector<PointSet> sets = all_point_sets();
  const bool smooth = key == "recursive_peak";
  std::vector<ExpectedCurve> curves = {{fixed_curve(notebook, sets[0], g), "-1/2"}};
  notebook.attempt([&] {
    curves.push_back({fixed_curve(notebook, sets[1], g), smooth ? "-1" : "-3/4"});
  });
  notebook.attempt([&] { curves.push_back({recursive_curve(notebook, g), "none exact"}); });
  notebook.table(key + "_slopes", slope_table(curves),
                 fmt::format("{}: slope of log error, with 95 % interval", g.name));
  notebook.table(key, measurement_table(curves_of(curves), 2), g.name);
  notebook.charts(error_charts(g.name, "RMS error", curves_of(curves)));
}

}  // namespace

void recursive_experiment(Notebook& notebook) {
  notebook.begin("Strata that adapt");
  const Integrand disc = darts(), narrow = peak();
  const bool done = notebook.attempt([&] {
    const std::string html = carlo::tiles({picture(notebook, disc, 1024, Background::disc),
                                           picture(notebook, disc, 16'384, Background::disc),
                                           picture(notebook, narrow, 1024, Background::peak),
                                           picture(notebook, narrow, 16'384, Background::peak)},
                                          15);
    notebook.say(
        "The strata that recursive stratification ends up with, drawn over what it integrates: the "
        "edge of the quarter disc, and a narrow peak. A box that is flat is left alone early; "
        "where the integrand varies, boxes are small.");
    notebook.raw_html(html);
  });
  if (!done) return;
  compare(notebook, "recursive_edge", disc);
  notebook.progress(1, 2);
  compare(notebook, "recursive_peak", narrow);
}

}  // namespace lab04
