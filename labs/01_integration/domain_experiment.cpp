#include "experiments.h"
#include "integrands.h"

#include <fmt/core.h>

#include <array>
#include <cmath>

// Domains that are not boxes: the unit ball inside its cube, in growing dimension.

namespace lab01 {
namespace {

constexpr std::array<std::size_t, 4> ball_dimensions = {2, 3, 5, 10};

/// [-1, 1)^d around the unit ball.
struct LargeCube {
  explicit LargeCube(std::size_t d) : lower(d, -1.0), upper(d, 1.0) {}
  std::vector<double> lower, upper;
};

double one(std::span<const double>) {
  return 1;
}

Estimate ball_volume(const LargeCube& cube, std::int64_t n, carlo::Rng& rng) {
  return integrate_domain(one, inside_unit_ball, {cube.lower, cube.upper}, n, rng);
}

Curve volume_curve(Notebook& notebook, std::size_t d) {
  const LargeCube cube(d);
  const double exact = unit_ball_volume(d);
  carlo::Rng rng = notebook.rng();
  Curve curve{fmt::format("ball, d = {}", d), {}};
  for (const std::int64_t n : ladder(64, notebook.options().n / 4)) {
    const auto trial = [&] { return Trial{ball_volume(cube, n, rng).value / exact, 1}; };
    curve.runs.push_back(repeat(n, notebook.repetitions(64), Summary::root_mean_square, trial));
  }
  return curve;
}

/// The fraction of the intervals value -+ 1.96 standard errors that hold the exact volume.
double coverage(Notebook& notebook, std::size_t d, std::int64_t n, int repetitions) {
  const LargeCube cube(d);
  const double exact = unit_ball_volume(d);
  carlo::Rng rng = notebook.rng();
  int held = 0;
  for (int i = 0; i < repetitions; ++i) {
    const Estimate e = ball_volume(cube, n, rng);
    if (std::fabs(e.value - exact) <= 1.96 * e.standard_error) ++held;
  }
  return static_cast<double>(held) / repetitions;
}

carlo::Table volume_table(Notebook& notebook) {
  constexpr std::int64_t n = 10'000;
  const int repetitions = notebook.repetitions(400);
  carlo::Table table({"d", "exact", "one estimate", "inside", "covered", "time"},
                     {"dimension", "exact", "estimate", "inside", "covered", "seconds"});
  for (const std::size_t d : ball_dimensions) {
    const LargeCube cube(d);
    const double exact = unit_ball_volume(d);
    carlo::Rng rng = notebook.rng();
    const Estimate estimate = ball_volume(cube, n, rng);
    const Measurement timed = time_rule(n, exact, [&] { return ball_volume(cube, n, rng).value; });
    const double inside = exact / std::pow(2.0, static_cast<double>(d));
    const double covered = coverage(notebook, d, n, repetitions);
    table.add_row({static_cast<std::int64_t>(d), exact,
                   carlo::interval_cell(estimate.value, 1.96 * estimate.standard_error),
                   carlo::Cell(fmt::format("{:.3g} %", 100 * inside), inside),
                   carlo::Cell(fmt::format("{:.1f} %", 100 * covered), covered),
                   carlo::seconds_cell(timed.seconds)});
  }
  return table;
}

}  // namespace

void domain_experiment(Notebook& notebook) {
  notebook.begin("A domain that is not a box");
  notebook.attempt([&] {
    std::vector<Curve> curves;
    for (std::size_t i = 0; i < ball_dimensions.size(); ++i) {
      notebook.progress(static_cast<double>(i), ball_dimensions.size() + 1.0);
      curves.push_back(volume_curve(notebook, ball_dimensions[i]));
    }
    const carlo::Table volumes = volume_table(notebook);
    notebook.say(
        "The volume of the unit ball, from points of the cube around it. No grid has to follow the "
        "boundary: a point is inside or contributes nothing. But the share of the cube that the "
        "ball fills shrinks fast with the dimension, and with it the use of a point.");
    notebook.table("domain", volumes,
                   "Volume ± 1.96 standard errors from N = 10 000 points; how many of such "
                   "intervals hold the exact value");
    notebook.table("domain_errors", measurement_table(curves, 5), "Relative to the exact volume");
    notebook.charts(error_charts("Volume of the ball", "relative RMS error", curves));
  });
}

}  // namespace lab01
