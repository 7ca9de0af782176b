#include "course/report/format.h"
#include "course/viewer/tiles.h"
#include "experiments.h"
#include "goodness.h"
#include "pictures.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <optional>

// The darts kept, the number needed, and the cost of a sample of either kind.

namespace lab05 {
namespace {

/// A function to draw from, its integral, and the inverse CDF where this lab has one.
struct Target {
  std::string name;
  Function f;
  double a, b, bound, integral;
  std::function<double(double)> inverse = nullptr;
};

Function power_function(double n) {
  return [n](double x) { return std::pow(x, n); };
}

Target power_target(double n) {
  return {fmt::format("x^{:g}", n), power_function(n), 0, 1, 1, 1 / (n + 1), [n](double u) {
            return sample_power(u, n);
          }};
}

std::vector<Target> targets() {
  return {
      {"line from 1 to 3", [](double x) { return 1 + 2 * x; }, 0, 1, 3, 2,
       [](double u) { return sample_linear(u, 1, 3); }},
      {"line, bound twice too high", [](double x) { return 1 + 2 * x; }, 0, 1, 6, 2,
       [](double u) { return sample_linear(u, 1, 3); }},
      {"tent, radius 2", [](double x) { return 1 - std::abs(x) / 2; }, -2, 2, 1, 2,
       [](double u) { return sample_tent(u, 2); }},
      {"exp(-x), cut at 12", [](double x) { return std::exp(-x); }, 0, 12, 1, -std::expm1(-12.0),
       [](double u) { return sample_exponential(u, 1); }},
      power_target(3),
      power_target(30),
      {"sin² of 1/(x + 0.1)",
       [](double x) {
         const double s = std::sin(1 / (x + 0.1));
         return s * s;
       },
       0, 1, 1,
       integral_over_cell([](double v) { return std::sin(v) * std::sin(v) / (v * v); }, 1 / 1.1,
                          10)},
  };
}

/// The cost of `count` samples.
struct Cost {
  double darts = 0;  ///< per sample, on average
  double seconds = 0;
};

Cost rejection_cost(const Target& t, std::int64_t count, carlo::Rng rng) {
  std::int64_t darts = 0;
  const double seconds = seconds_a_draw(count, [&] {
    const auto drawn = sample_by_rejection(t.f, t.a, t.b, t.bound, rng);
    darts += drawn.darts;
    return drawn.value;
  });
  constexpr double rounds = 3;
  return {static_cast<double>(darts) / (rounds * static_cast<double>(count)), seconds};
}

std::optional<double> inversion_seconds(Notebook& notebook, const Target& t, std::int64_t count) {
  std::optional<double> seconds;
  if (!t.inverse) return seconds;
  carlo::Rng rng = notebook.rng();
  notebook.attempt(
      [&] { seconds = seconds_a_draw(count, [&] { return t.inverse(rng.uniform()); }); });
  return seconds;
}

/// The acceptance rate, from the count of darts: negative binomial, so rate = 1 / mean with a
/// relative standard error sqrt((1 - p) / samples).
carlo::Cell share_cell(double darts, double p, std::int64_t samples) {
  const double half = 1.96 * p * std::sqrt((1 - p) / static_cast<double>(samples));
  return carlo::interval_cell(1 / darts, half);
}

void cost_table(Notebook& notebook, std::int64_t count) {
  carlo::Table table({"function", "kept, theory", "kept, measured", "z", "darts", "rejection",
                      "inversion", "ratio"},
                     {"function", "acceptance", "acceptance_measured", "z", "darts",
                      "seconds_rejection", "seconds_inversion", "ratio"});
  for (const Target& t : targets()) {
    notebook.attempt([&] {
      const double p = acceptance_rate(t.integral, t.a, t.b, t.bound);
      const Cost cost = rejection_cost(t, count, notebook.rng());
      const double spread = std::sqrt((1 - p) / (3 * static_cast<double>(count))) / p;
      const auto inversion = inversion_seconds(notebook, t, count);
      table.add_row({t.name, p, share_cell(cost.darts, p, 3 * count),
                     carlo::Cell(fmt::format("{:+.1f}", (cost.darts - 1 / p) / spread),
                                 (cost.darts - 1 / p) / spread),
                     cost.darts, carlo::seconds_cell(cost.seconds),
                     inversion ? carlo::seconds_cell(*inversion) : carlo::empty_cell(),
                     inversion ? carlo::Cell(cost.seconds / *inversion) : carlo::empty_cell()});
    });
  }
  notebook.table("rejection", table,
                 fmt::format("Cost of one accepted sample, from {} samples a row; z: how many "
                             "standard errors the mean number of darts lies off 1/p",
                             carlo::count_text(3 * count)));
}

/// The cost of a sample of x^n against the darts it takes, for growing n.
void cost_chart(Notebook& notebook, std::int64_t count) {
  carlo::Series rejection{"rejection", {}}, inversion{"inversion", {}};
  for (const double n : {0.0, 1.0, 3.0, 7.0, 15.0, 31.0, 63.0}) {
    const Target t = power_target(n);
    notebook.attempt([&] {
      rejection.points.push_back({n + 1, rejection_cost(t, count / 4, notebook.rng()).seconds});
    });
    const auto seconds = inversion_seconds(notebook, t, count);
    if (seconds) inversion.points.push_back({n + 1, *seconds});
  }
  notebook.charts({{"The cost of x^n",
                    "one over the share of darts kept is n + 1",
                    {"darts a sample, 1/p"},
                    {"time of one sample", carlo::Unit::seconds},
                    {rejection, inversion}}});
}

std::string picture(const Target& t, carlo::Rng rng) {
  constexpr int thrown = 1200;
  std::vector<Point> darts;
  for (int i = 0; i < thrown; ++i) {
    const double x = t.a + (t.b - t.a) * rng.uniform();
    const double y = t.bound * rng.uniform();
    darts.push_back({x, y});
  }
  const auto kept =
      std::count_if(darts.begin(), darts.end(), [&](const Point& d) { return d.y < t.f(d.x); });
  return darts_picture(t.name, fmt::format("{} of {} darts kept", kept, thrown),
                       {t.a, t.b, t.bound}, t.f, darts);
}

}  // namespace

void rejection_experiment(Notebook& notebook) {
  notebook.begin("Rejection: which darts are kept, and what they cost");
  notebook.say(
      "Darts fall uniformly on the rectangle; those below the graph are kept, and their x has the "
      "density. The share kept is the share of the rectangle that lies under the graph, so a loose "
      "bound or a narrow peak is paid for in darts. The last function has no inverse CDF that "
      "anybody would want to write down; rejection does not mind.");
  const std::vector<Target> all = targets();
  std::vector<std::string> pictures;
  for (const std::size_t i : {std::size_t{0}, std::size_t{1}, std::size_t{5}, all.size() - 1})
    pictures.push_back(picture(all[i], notebook.rng()));
  notebook.raw_html(carlo::tiles(pictures, 19));
  const std::int64_t count = notebook.options().quick ? 20'000 : 200'000;
  notebook.progress(1, 3);
  cost_table(notebook, count);
  notebook.progress(2, 3);
  cost_chart(notebook, count);
}

}  // namespace lab05
