#include "course/report/format.h"
#include "course/viewer/tiles.h"
#include "practice.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

// "Noise removal (filtering) and irradiance caching (photon maps) used in practice": all methods on
// the same scenes, error against seconds of one thread, with bias and noise separated.

namespace lab09 {
namespace {

constexpr double hour = 3600;

std::string time_in_words(double seconds, bool at_least) {
  if (seconds == 0) return "from the start";
  if (!std::isfinite(seconds)) return "never";
  if (seconds > 1e4 * hour) return "after a year and more";
  return (at_least ? "not before " : "after ") + (seconds > 2 * hour
                                                      ? carlo::number_text(seconds / hour, 3) + " h"
                                                      : carlo::duration_text(seconds));
}

void add_measured(carlo::Table& table, const std::string& scene,
                  const std::vector<PracticeCurve>& curves) {
  const PracticeRun& paths = curves.front().longest();
  for (const PracticeCurve& curve : curves) {
    const PracticeRun& run = curve.longest();
    table.add_row(
        {scene, curve.name, run.passes, carlo::seconds_cell(run.seconds),
         carlo::interval_cell(run.parts.bias2, 2 * run.parts.bias_error),
         carlo::number_cell(run.parts.variance), carlo::number_cell(run.rel_mse()),
         carlo::number_cell(run.rel_mse() * run.seconds / (paths.rel_mse() * paths.seconds))});
  }
}

void add_predicted(carlo::Table& table, const std::string& scene,
                   const std::vector<PracticeCurve>& curves) {
  const PracticeCurve& paths = curves.front();
  for (const PracticeCurve& curve : curves) {
    const double overtaken = overtaking(paths, curve), after_hour = curve.predicted(hour);
    const bool bounded = curve.bias_is_bounded();
    const std::string error = carlo::number_text(after_hour, 3);
    table.add_row({scene, curve.name, carlo::Cell(bounded ? "at most " + error : error, after_hour),
                   &curve == &paths ? carlo::empty_cell()
                                    : carlo::Cell(time_in_words(overtaken, bounded), overtaken)});
  }
}

std::string ahead_at(const std::vector<PracticeCurve>& curves, double t) {
  const auto best = std::min_element(curves.begin(), curves.end(),
                                     [t](const PracticeCurve& a, const PracticeCurve& b) {
                                       return a.predicted(t) < b.predicted(t);
                                     });
  return best->name;
}

carlo::Chart practice_chart(const std::string& scene, const std::vector<PracticeCurve>& curves) {
  carlo::Chart chart{
      scene, "measured", {"seconds of one thread", carlo::Unit::seconds}, {"relMSE"}, {}};
  for (const PracticeCurve& curve : curves) {
    carlo::Series series{curve.name, {}};
    for (const PracticeRun& run : curve.runs)
      series.points.push_back({run.seconds, run.rel_mse()});
    chart.series.push_back(series);
  }
  return chart;
}

std::string practice_pictures(const PracticeScene& scene,
                              const std::vector<PracticeCurve>& curves) {
  constexpr double white = 1;
  std::vector<std::string> row = {carlo::image_tile(
      "reference", fmt::format("{0}, {1} x {1} pixels", scene.name, scene.reference.width),
      scene.reference, white)};
  for (const PracticeCurve& curve : curves) {
    const PracticeRun& run = curve.longest();
    row.push_back(carlo::image_tile(curve.name,
                                    fmt::format("{}: relMSE {}", carlo::duration_text(run.seconds),
                                                carlo::number_text(run.rel_mse(), 2)),
                                    run.shown, white));
  }
  return carlo::tiles(row);
}

/// All available methods on one scene; none if the path tracer is missing.
std::vector<PracticeCurve> practice_curves(Notebook& notebook, const PracticeScene& scene,
                                           double seconds, double done, double total) {
  std::vector<PracticeCurve> curves;
  const std::vector<PracticeMethod> methods = practice_methods(scene);
  for (std::size_t i = 0; i < methods.size(); ++i) {
    const bool there = notebook.attempt(
        [&] { curves.push_back(measure_practice(notebook, scene, methods[i], seconds)); });
    if (!there && i == 0) return {};
    notebook.progress(done + static_cast<double>(i + 1) / static_cast<double>(methods.size()),
                      total);
  }
  return curves;
}

}  // namespace

void practice_experiment(Notebook& notebook) {
  notebook.begin("In practice");
  const bool quick = notebook.options().quick;
  const PracticeOptions& options = practice_options;
  const double seconds = options.seconds > 0 ? options.seconds : quick ? 0.25 : 1;
  std::vector<std::string> scenes = practice_scenes;
  if (!options.scene.empty()) {
    scenes = {options.scene};
  } else if (quick) {
    scenes.resize(1);
  }
  notebook.say(fmt::format(
      "Scenes of common/scenes, {} of one thread for each image. relMSE is the "
      "mean of (error/reference)², dark pixels counted as .1; it is the sum of bias² and noise², "
      "which several images with other random numbers tell apart.",
      carlo::duration_text(seconds)));
  carlo::Table table(
      {"scene", "method", "passes", "time", "bias²", "noise²", "relMSE", "over path tracing's"},
      {"scene", "method", "passes", "seconds", "bias2", "variance", "rel_mse", "ratio"});
  carlo::Table predicted({"scene", "method", "relMSE after an hour", "path tracing overtakes"},
                         {"scene", "method", "hour", "overtaken"});
  carlo::Table ahead({"scene", "ahead after " + carlo::duration_text(seconds), "after an hour"},
                     {"scene", "soon", "late"});
  std::vector<carlo::Chart> charts;
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    const PracticeScene scene(scenes[i], quick ? 64 : 256);
    const std::vector<PracticeCurve> curves = practice_curves(
        notebook, scene, seconds, static_cast<double>(i), static_cast<double>(scenes.size()));
    if (curves.empty()) return;
    notebook.raw_html(practice_pictures(scene, curves));
    charts.push_back(practice_chart(scene.name, curves));
    add_measured(table, scene.name, curves);
    add_predicted(predicted, scene.name, curves);
    ahead.add_row({scene.name, ahead_at(curves, seconds), ahead_at(curves, hour)});
  }
  notebook.charts(charts);
  notebook.numbers("practice", table, "Bias, noise and time of all methods");
  notebook.numbers("practice_predicted", predicted, "What the curves predict");
  notebook.table("practice_ahead", ahead, "Who is ahead: measured, and predicted for an hour");
}

}  // namespace lab09
