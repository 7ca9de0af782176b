#include "course/report/chart.h"
#include "course/report/format.h"
#include "course/viewer/tiles.h"
#include "experiments.h"
#include "pi.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

// Darts on their board, and the estimate as it settles down.

namespace lab02 {
namespace {

/// 1, 2, 3, ... then ever further apart: about twelve numbers a decade, up to `last`.
std::vector<std::int64_t> stops(std::int64_t last) {
  std::vector<std::int64_t> result;
  for (std::int64_t n = 1; n < last; n = std::max(n + 1, n * 6 / 5))
    result.push_back(n);
  result.push_back(last);
  return result;
}

struct Step {
  Darts darts;
  Estimate estimate;
  std::optional<Interval> interval;
};

/// The same darts throughout: each step throws those that are missing.
std::vector<Step> throw_in_steps(Notebook& notebook, carlo::Rng rng) {
  std::vector<Step> steps;
  Darts darts;
  bool intervals = true;
  for (const std::int64_t n : stops(notebook.options().n)) {
    const Darts more = throw_darts(n - darts.thrown, rng);
    darts = {darts.thrown + more.thrown, darts.hits + more.hits};
    Step step{darts, pi_estimate(darts), std::nullopt};
    if (intervals) intervals = notebook.attempt([&] { step.interval = pi_interval(darts, z95); });
    steps.push_back(step);
  }
  return steps;
}

constexpr std::int64_t most_drawn = 3000;

/// The quarter disc; each step adds its darts.
std::string board(const std::vector<Step>& steps, carlo::Rng rng) {
  const carlo::Plot square({0, 1}, {0, 1}, {400, 400});
  carlo::Plot plot = square;
  std::vector<carlo::Point> edge;
  for (int degrees = 0; degrees <= 90; ++degrees) {
    const double angle = degrees * std::numbers::pi / 180;
    edge.push_back({std::cos(angle), std::sin(angle)});
  }
  plot.line("", edge);
  std::int64_t drawn = 0;
  for (std::size_t i = 0; i < steps.size() && drawn < most_drawn; ++i) {
    std::vector<carlo::Point> hits, misses;
    for (; drawn < std::min(most_drawn, steps[i].darts.thrown); ++drawn) {
      const double x = rng.uniform();
      const double y = rng.uniform();
      (x * x + y * y < 1 ? hits : misses).push_back({x, y});
    }
    carlo::Plot layer = square;
    layer.dots("c1", hits, 4);
    layer.dots("c2", misses, 4);
    plot.add(carlo::shown_at(i, steps.size(), layer.body()));
  }
  const std::vector<carlo::Key> keys{{"c1", "●", "hits"}, {"c2", "●", "misses"}};
  return carlo::tile("The board", fmt::format("the first {} darts at most", most_drawn),
                     carlo::legend_html(keys) +
                         plot.svg("The unit square with the quarter disc and the darts so far"));
}

/// The estimate and its interval against N; a line marks the slider's position.
std::string way(const std::vector<Step>& steps) {
  std::vector<carlo::Point> estimates, upper, lower;
  std::vector<double> darts;
  for (const Step& step : steps) {
    const auto n = static_cast<double>(step.darts.thrown);
    darts.push_back(n);
    estimates.push_back({n, step.estimate.value});
    if (!step.interval) continue;
    upper.push_back({n, step.interval->upper});
    lower.push_back({n, step.interval->lower});
  }
  const carlo::Axis x{"darts N", carlo::Unit::count};
  const carlo::Axis y{"", carlo::Unit::number, carlo::Scale::linear};
  const carlo::Stretch across = carlo::round_stretch(x, darts), up{2.5, 4};
  const carlo::Plot axes(x, across, y, up, {400, 400});
  carlo::Plot plot = axes;
  plot.band("c1", upper, lower);
  const std::vector<carlo::Point> pi{{across.first, std::numbers::pi},
                                     {across.last, std::numbers::pi}};
  plot.line("dashed", pi);
  plot.line("c1", estimates);
  for (std::size_t i = 0; i < steps.size(); ++i) {
    carlo::Plot layer = axes;
    layer.vertical("c2", estimates[i].x);
    layer.mark("c2", 0, estimates[i], "");
    plot.add(carlo::shown_at(i, i, layer.body()));
  }
  return carlo::tile("The estimate on its way",
                     "the line is 4 hits/N, the band its 95 % interval, the dashes are π",
                     plot.svg("Estimate of π and its interval against the number of darts"));
}

std::string words(const Step& step) {
  const int digits =
      std::max(2, static_cast<int>(std::ceil(std::log10(step.darts.thrown) / 2)) + 1);
  std::string text =
      fmt::format("{}: {} {}, π ≈ {:.{}f}", carlo::count_text(step.darts.thrown),
                  carlo::count_text(step.darts.hits), step.darts.hits == 1 ? "hit" : "hits",
                  step.estimate.value, digits);
  if (step.interval)
    text += fmt::format(", 95 %: {:.{}f} … {:.{}f}", step.interval->lower, digits,
                        step.interval->upper, digits);
  return text;
}

std::string board_slider(const std::vector<Step>& steps, const carlo::Rng& rng) {
  std::vector<std::string> said;
  std::size_t start = 0;
  for (const Step& step : steps) {
    if (step.darts.thrown < 1000) ++start;
    said.push_back(words(step));
  }
  return carlo::slider_html("Darts thrown", said, std::min(start, steps.size() - 1),
                            carlo::tiles({board(steps, rng), way(steps)}, 24));
}

carlo::Table steps_table(const std::vector<Step>& steps) {
  carlo::Table table({"N", "hits", "estimate", "standard error", "95 % interval", "error"},
                     {"points", "hits", "estimate", "standard_error", "interval", "error"});
  for (std::size_t i = steps.size() % 8; i < steps.size(); i += 8) {
    const Step& s = steps[i];
    const std::string interval =
        s.interval ? fmt::format("{} … {}", carlo::number_text(s.interval->lower, 5),
                                 carlo::number_text(s.interval->upper, 5))
                   : "";
    table.add_row({s.darts.thrown, s.darts.hits, carlo::number_cell(s.estimate.value, 6),
                   s.estimate.standard_error, interval, s.estimate.value - std::numbers::pi});
  }
  return table;
}

/// The first darts, for drawing.
carlo::Table darts_table(carlo::Rng rng) {
  constexpr int drawn = 600;
  carlo::Table table({"x", "y", "dart"}, {"x", "y", "dart"});
  for (int i = 0; i < drawn; ++i) {
    const double x = rng.uniform();
    const double y = rng.uniform();
    table.add_row({x, y, std::hypot(x, y) < 1 ? "hit" : "miss"});
  }
  return table;
}

}  // namespace

void board_experiment(Notebook& notebook) {
  notebook.begin("Darts");
  notebook.attempt([&] {
    const carlo::Rng rng = notebook.rng();
    const std::vector<Step> steps = throw_in_steps(notebook, rng);
    notebook.say(
        "Darts at a square, of which the quarter disc fills π/4. Each dart adds to those before "
        "it; the interval is the one of Lab 2.2.");
    notebook.table("darts", steps_table(steps), "One run: the estimate after N darts");
    notebook.raw_html(board_slider(steps, rng));
    notebook.script(carlo::slider_script());
    notebook.data("board", darts_table(rng), "The first 600 darts");
  });
}

}  // namespace lab02
