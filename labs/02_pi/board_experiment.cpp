#include "board.h"
#include "experiments.h"
#include "pi.h"
#include "report/format.h"

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

// Darts on their board, and the estimate settling down.

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

/// The same darts all along: each step throws those that are missing.
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

nlohmann::json board_data(const std::vector<Step>& steps, carlo::Rng rng) {
  constexpr std::int64_t most_drawn = 3000;
  nlohmann::json points = nlohmann::json::array();
  for (std::int64_t i = 0; i < std::min(most_drawn, steps.back().darts.thrown); ++i) {
    const double x = rng.uniform();
    const double y = rng.uniform();
    points.push_back({std::round(x * 1e4) / 1e4, std::round(y * 1e4) / 1e4});
  }
  nlohmann::json rows = nlohmann::json::array();
  for (const Step& step : steps) {
    nlohmann::json row = {step.darts.thrown, step.darts.hits, step.estimate.value, nullptr,
                          nullptr};
    if (step.interval) {
      row[3] = step.interval->lower;
      row[4] = step.interval->upper;
    }
    rows.push_back(row);
  }
  return {{"points", points}, {"steps", rows}};
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
    table.add_row({s.darts.thrown, s.darts.hits,
                   carlo::Cell(carlo::number_text(s.estimate.value, 6), s.estimate.value),
                   s.estimate.standard_error, interval, s.estimate.value - std::numbers::pi});
  }
  return table;
}

/// The first darts, for whoever wants to draw them.
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
    notebook.raw_html(board_html());
    notebook.script(board_script(board_data(steps, rng)));
    notebook.data("board", darts_table(rng), "The first 600 darts");
  });
}

}  // namespace lab02
