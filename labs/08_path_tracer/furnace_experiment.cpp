#include "course/report/stopwatch.h"
#include "course/viewer/tiles.h"
#include "experiments.h"
#include "images/images.h"
#include "numeric/robust.h"
#include "stats/running_mean.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

// Step d: inside a sphere whose wall emits 1 and reflects the fraction rho, everything has radiance
// 1/(1 - rho). The lecture's rule is right on average, but its error bars are not.

namespace lab08 {
namespace {

using Rule = Rgb (*)(const World&, const Ray&, Rng&);

struct FurnaceMethod {
  std::string name;
  Rule rule;
};

std::vector<FurnaceMethod> furnace_methods() {
  return {{"lecture's rule", trace_path_lecture}, {"mended", trace_path}};
}

carlo::Scene furnace(float rho, int size) {
  carlo::Scene scene;
  scene.materials = {{carlo::Diffuse{Rgb(rho)}, false}};
  scene.shapes = {{carlo::Sphere{{0, 0, 0}, 2, true}, 0, Rgb(1)}};
  scene.camera.fit_film(size, size);
  return scene;
}

using carlo::RunningMean;

/// True if the error bar, computed as usual, covers the exact value.
bool covers(const RunningMean& run, double exact) {
  return std::abs(run.mean() - exact) <= 1.96 * run.error();
}

double red(const World& world, Rule rule, Rng& rng) {
  const Ray ray{{0, 0, 1}, {0.6f, 0, -0.8f}};
  return static_cast<double>(rule(world, ray, rng).r);
}

/// The statistics of many runs of each length.
struct Coverage {
  Curve curve;
  std::vector<double> reported, missed;  ///< for each length: median standard error; fraction of
                                         ///< misses
};

Coverage coverage(Notebook& notebook, const World& world, const FurnaceMethod& method,
                  double exact) {
  Coverage result{{method.name, {}}, {}, {}};
  const int runs = notebook.options().quick ? 60 : 200;
  for (const std::int64_t n : carlo::ladder(16, notebook.options().n / 64)) {
    Rng rng = notebook.rng();
    std::vector<double> errors;
    double square = 0, missed = 0;
    const carlo::Stopwatch watch;
    RunningMean run;
    for (int i = 0; i < runs; ++i) {
      run = {};
      for (std::int64_t k = 0; k < n; ++k)
        run.add(red(world, method.rule, rng));
      square += (run.mean() - exact) * (run.mean() - exact) / runs;
      missed += covers(run, exact) ? 0 : 1.0 / runs;
      errors.push_back(run.error());
    }
    std::nth_element(errors.begin(), errors.begin() + runs / 2, errors.end());
    result.curve.runs.push_back({n, run.mean(), std::sqrt(square), watch.seconds() / runs});
    result.reported.push_back(errors[static_cast<std::size_t>(runs) / 2]);
    result.missed.push_back(missed);
  }
  return result;
}

/// One long run: its mean and its error bars as it proceeds.
carlo::Chart running_chart(Notebook& notebook, const World& world, const FurnaceMethod& method,
                           double exact) {
  carlo::Chart chart{"One run: " + method.name,
                     "the mean so far and 95 % error bars",
                     {"paths N", carlo::Unit::count},
                     {"radiance", carlo::Unit::number, carlo::Scale::linear},
                     {{"mean", {}}, {"mean + 1.96 se", {}}, {"mean - 1.96 se", {}}, {"exact", {}}}};
  Rng rng = notebook.rng();
  RunningMean run;
  double next = 64;
  while (run.count() < static_cast<double>(notebook.options().n)) {
    run.add(red(world, method.rule, rng));
    if (run.count() < next) continue;
    next *= 1.25;
    chart.series[0].points.push_back({run.count(), run.mean()});
    chart.series[1].points.push_back({run.count(), run.mean() + 1.96 * run.error()});
    chart.series[2].points.push_back({run.count(), run.mean() - 1.96 * run.error()});
    chart.series[3].points.push_back({run.count(), exact});
  }
  return chart;
}

/// The standard deviation of one path. For the lecture's, M = 1/p + rho M/(1 - p) is the mean
/// square.
double deviation(bool lecture, double rho) {
  constexpr double p = 0.9;
  const double mean = 1 / (1 - rho);
  if (!lecture) return std::sqrt((1 + 2 * rho * mean) / (1 - rho) - mean * mean);
  const double ratio = rho / (1 - p);
  return ratio < 1 ? std::sqrt(1 / p / (1 - ratio) - mean * mean) : INFINITY;
}

carlo::Table albedos_table(Notebook& notebook) {
  carlo::Table table({"albedo", "method", "exact", "mean", "deviation", "theory"},
                     {"albedo", "method", "exact", "mean", "deviation", "deviation_theory"});
  for (const double rho : {0.05, 0.5, 0.8}) {
    const World world(furnace(static_cast<float>(rho), 16));
    bool lecture = true;
    for (const FurnaceMethod& method : furnace_methods()) {
      notebook.attempt([&] {
        Rng rng = notebook.rng();
        RunningMean run;
        for (std::int64_t i = 0; i < notebook.options().n; ++i)
          run.add(red(world, method.rule, rng));
        const double theory = deviation(lecture, rho);
        table.add_row({rho, method.name, 1 / (1 - rho),
                       carlo::interval_cell(run.mean(), 1.96 * run.error()), run.deviation(),
                       std::isinf(theory) ? carlo::Cell("infinite") : carlo::Cell(theory)});
      });
      lecture = false;
    }
  }
  return table;
}

/// The room itself: every pixel should show 2.
std::string room(Notebook& notebook, const World& world, int size) {
  constexpr int samples = 64;
  std::vector<std::string> row = {carlo::image_tile(
      "exact", "2 everywhere", render(size, size, 0, [](int, int, Rng&) { return Rgb(2); }), 4)};
  for (const FurnaceMethod& method : furnace_methods()) {
    notebook.attempt([&] {
      row.push_back(carlo::image_tile(
          method.name, fmt::format("{} samples a pixel", samples),
          render(size, size, notebook.rng().next_u64(),
                 [&](int x, int y, Rng& rng) {
                   const Ray ray = middle_ray(world.scene().camera, size, size, x, y);
                   return mean_of(samples, [&] { return method.rule(world, ray, rng); });
                 }),
          4));
    });
  }
  return carlo::tiles(row);
}

void say_coverage(Notebook& notebook, const std::vector<Coverage>& all) {
  carlo::Table table({"method", "paths N", "true error", "reported error", "intervals that miss"},
                     {"method", "n", "error", "reported", "missed"});
  std::vector<Curve> curves;
  for (const Coverage& c : all) {
    for (std::size_t i = 0; i < c.curve.runs.size(); ++i) {
      table.add_row({c.curve.name, c.curve.runs[i].points, c.curve.runs[i].error, c.reported[i],
                     carlo::percent_cell(c.missed[i])});
    }
    curves.push_back(c.curve);
  }
  notebook.table("coverage", table,
                 "Many runs of N paths at albedo .5: root mean square error, the median of the "
                 "standard errors that the runs report, and how many 95 % intervals miss 2 (5 % "
                 "should)");
  carlo::Table slopes({"method", "slope against N", "slope against time"},
                      {"method", "slope_points", "slope_seconds"});
  for (const Curve& curve : curves)
    slopes.add_row(
        {curve.name, slope_cell(curve.against_points()), slope_cell(curve.against_seconds())});
  notebook.table("furnace_slopes", slopes, "Slope of log error, with 95 % interval");
  notebook.charts(carlo::error_charts("Furnace of albedo .5", "RMS error of many runs", curves));
}

}  // namespace

void furnace_experiment(Notebook& notebook) {
  notebook.begin("Step d: TracePath in a furnace");
  constexpr double exact = 2;
  const int size = image_size(notebook, 48);
  const World world(furnace(0.5f, size));
  std::vector<Coverage> all;
  std::vector<carlo::Chart> charts;
  double done = 0;
  for (const FurnaceMethod& method : furnace_methods()) {
    notebook.attempt([&] {
      all.push_back(coverage(notebook, world, method, exact));
      charts.push_back(running_chart(notebook, world, method, exact));
    });
    notebook.progress(++done, 3);
  }
  if (all.empty()) return;
  notebook.say(
      "Within a sphere whose wall emits 1 and reflects half of what it gets, every ray has "
      "radiance 1 + 1/2 + 1/4 + ... = 2. The lecture's rule chooses emission with probability "
      ".9; otherwise it continues, and multiplies by 10. Its mean is 2 and its variance "
      "infinite, so the spread of the samples seen so far says nothing about those to come.");
  notebook.raw_html(room(notebook, world, size));
  notebook.charts(charts);
  say_coverage(notebook, all);
  notebook.table("albedos", albedos_table(notebook),
                 "One run at other albedos: mean with the 95 % interval it reports, standard "
                 "deviation of one path");
}

}  // namespace lab08
