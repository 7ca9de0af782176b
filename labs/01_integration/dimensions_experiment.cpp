#include "course/report/format.h"
#include "experiments.h"
#include "integrands.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>

// The curse of dimensionality: the nested midpoint rule against Monte Carlo in growing dimension.

namespace lab01 {
namespace {

constexpr std::array<std::size_t, 6> dimensions = {1, 2, 3, 4, 6, 8};
constexpr std::size_t shown_dimension = 6;

/// The unit cube in d dimensions.
class Cube {
 public:
  explicit Cube(std::size_t d) : lower_(d, 0.0), upper_(d, 1.0) {}
  Box box() const { return {lower_, upper_}; }

 private:
  std::vector<double> lower_, upper_;
};

/// n^d, or more than `limit` where it would be larger.
std::int64_t cells(std::int64_t n, std::size_t d, std::int64_t limit) {
  std::int64_t product = 1;
  for (std::size_t i = 0; i < d && product <= limit; ++i)
    product *= n;
  return product;
}

/// The next n per side: about four times as many cells, but at least one more per side.
std::int64_t next_side(std::int64_t n, std::size_t d) {
  const double grown = static_cast<double>(n) * std::pow(4, 1 / static_cast<double>(d));
  return std::max(n + 1, static_cast<std::int64_t>(std::lround(grown)));
}

/// Errors are relative to the integral, so that dimensions can be compared.
Measurement relative(Measurement m, double integral) {
  m.error /= integral;
  m.estimate /= integral;
  return m;
}

Curve nested_curve(Notebook& notebook, std::size_t d) {
  const Cube cube(d);
  const double exact = exponential_nd_integral(d);
  // A slope needs four points: in eight dimensions 2 to 5 per side.
  const std::int64_t limit = std::max<std::int64_t>(4 * notebook.options().n, 400'000);
  Curve curve{fmt::format("midpoint, d = {}", d), {}};
  for (std::int64_t n = 2; cells(n, d, limit) <= limit; n = next_side(n, d)) {
    const auto rule = [&] { return nested_midpoint(exponential_nd, cube.box(), n); };
    curve.runs.push_back(relative(time_rule(cells(n, d, limit), exact, rule), exact));
  }
  return curve;
}

Curve monte_carlo_curve(Notebook& notebook, std::size_t d) {
  const Cube cube(d);
  const double exact = exponential_nd_integral(d);
  carlo::Rng rng = notebook.rng();
  Curve curve{fmt::format("Monte Carlo, d = {}", d), {}};
  for (const std::int64_t n : ladder(16, notebook.options().n)) {
    const auto trial = [&] {
      return Trial{integrate_box(exponential_nd, cube.box(), n, rng), exact};
    };
    curve.runs.push_back(
        relative(repeat(n, notebook.repetitions(32), Summary::root_mean_square, trial), exact));
  }
  return curve;
}

/// Where Monte Carlo overtakes the rule, or why it does not.
carlo::Cell crossing_cell(const std::optional<carlo::PowerFit>& rule,
                          const std::optional<carlo::PowerFit>& dice, bool seconds) {
  if (!rule || !dice) return carlo::empty_cell();
  const double at = carlo::crossing(*rule, *dice);
  // If the data cannot tell the slopes apart, the crossing is not worth printing.
  if (std::fabs(rule->slope - dice->slope) < rule->slope_half_width + dice->slope_half_width) {
    return {"undecided", std::nan("")};
  }
  if (dice->slope >= rule->slope) return {"never", std::nan("")};
  return {seconds ? carlo::duration_text(at) : carlo::number_text(at, 3), at};
}

carlo::Table slopes(const std::vector<Curve>& rules, const std::vector<Curve>& dice) {
  carlo::Table table({"d", "theory", "midpoint", "Monte Carlo", "dice win from N", "from time"},
                     {"dimension", "theory", "slope_midpoint", "slope_monte_carlo",
                      "crossing_points", "crossing_seconds"});
  for (std::size_t i = 0; i < dimensions.size(); ++i) {
    const auto d = static_cast<std::int64_t>(dimensions[i]);
    const auto rule_slope = i < rules.size() ? rules[i].against_points() : std::nullopt;
    const auto dice_slope = i < dice.size() ? dice[i].against_points() : std::nullopt;
    const auto rule_time = i < rules.size() ? rules[i].against_seconds() : std::nullopt;
    const auto dice_time = i < dice.size() ? dice[i].against_seconds() : std::nullopt;
    table.add_row({d, fmt::format("-2/{}", d), slope_cell(rule_slope), slope_cell(dice_slope),
                   crossing_cell(rule_slope, dice_slope, false),
                   crossing_cell(rule_time, dice_time, true)});
  }
  return table;
}

}  // namespace

void dimensions_experiment(Notebook& notebook) {
  notebook.begin("The curse of dimensionality");
  std::vector<Curve> rules, dice, duel;
  double step = 0;
  const auto advance = [&] { notebook.progress(step++, 2.0 * dimensions.size()); };
  notebook.attempt([&] {
    for (const std::size_t d : dimensions) {
      advance();
      rules.push_back(nested_curve(notebook, d));
      if (d == shown_dimension) duel.push_back(rules.back());
    }
  });
  notebook.attempt([&] {
    for (const std::size_t d : dimensions) {
      advance();
      dice.push_back(monte_carlo_curve(notebook, d));
      if (d == shown_dimension) duel.push_back(dice.back());
    }
  });
  if (rules.empty() && dice.empty()) return;

  notebook.say(
      "The integral of exp(x_1 + ... + x_d) over the unit cube; errors are relative. With N points "
      "in all, the nested rule has only N^(1/d) of them a side, so its error falls as N^(-2/d). "
      "Monte Carlo's slope does not depend on the dimension. Where the two fitted lines meet, Monte "
      "Carlo takes over: counted in points, and in seconds, for a random point costs more than a "
      "point of a grid. A crossing outside the measured range is an extrapolation; \"undecided\" "
      "means that the two slopes cannot be told apart.");
  notebook.table("dimensions_slopes", slopes(rules, dice),
                 "Slope of log error against N, with 95 % interval");
  notebook.table("dimensions", measurement_table(duel, 2),
                 fmt::format("Relative to the exact integral, d = {}", shown_dimension));
  if (!rules.empty()) notebook.charts(error_charts("Nested midpoint", "relative error", rules));
  if (!dice.empty()) notebook.charts(error_charts("Monte Carlo", "relative error", dice));
  if (duel.size() == 2) {
    notebook.charts(
        error_charts(fmt::format("Both in d = {}", shown_dimension), "relative error", duel));
  }
}

}  // namespace lab01
