#include "experiments.h"
#include "importance.h"
#include "power_family.h"

#include <algorithm>
#include <functional>
#include <vector>

// Rejection samples as importance samples: the shape x^2 for f = 5 x^4.

namespace lab06 {
namespace {

double square(double x) {
  return x * x;
}

/// The contributions of `n` darts or samples.
struct DartWay {
  std::string name;
  double variance;  ///< of one dart or sample, in theory
  std::function<std::vector<double>(std::int64_t n, carlo::Rng& rng)> draw;
};

/// E[Y^2] of a dart is (b - a) g_max ∫ f^2/g = g_max 25/7; of a sample with density 3 x^2 it is
/// 25/21.
std::vector<DartWay> rejection_ways() {
  const auto darts = [](double g_max) {
    return [g_max](std::int64_t n, carlo::Rng& rng) {
      return rejection_contributions(power_f, square, 0, 1, g_max, n, rng);
    };
  };
  return {{"darts under 1", 25.0 / 7 - 1, darts(1)},
          {"darts under 3", 75.0 / 7 - 1, darts(3)},
          {"inversion, 3x²", 25.0 / 21 - 1, [](std::int64_t n, carlo::Rng& rng) {
             return contributions(power_f, power_density(2), n, rng);
           }}};
}

double mean(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values)
    sum += value;
  return sum / static_cast<double>(values.size());
}

void way_table(Notebook& notebook) {
  const std::int64_t n = notebook.options().n;
  carlo::Table table(
      {"way", "N", "estimate", "standard error", "variance", "theory", "time", "efficiency"},
      {"way", "points", "estimate", "standard_error", "variance", "variance_theory", "seconds",
       "efficiency"});
  for (const DartWay& way : rejection_ways()) {
    notebook.attempt([&] {
      carlo::Rng rng = notebook.rng();
      const Estimate e = summarize(way.draw(n, rng));
      const std::int64_t draws = n / 8;
      const double seconds =
          best_seconds([&] { return way.draw(draws, rng).back(); }) / static_cast<double>(draws);
      table.add_row({way.name, n, e.value, e.standard_error, e.variance, way.variance,
                     carlo::seconds_cell(seconds), efficiency(e.variance, seconds)});
    });
  }
  notebook.table("rejection", table,
                 "∫ 5x⁴ = 1 with the shape x²; variance and time of one dart or sample");
}

/// The results of forgetting something: the kept darts' mean alone, and f/g.
void mistakes(Notebook& notebook) {
  carlo::Rng rng = notebook.rng();
  std::vector<double> kept =
      rejection_contributions(power_f, square, 0, 1, 1, notebook.options().n, rng);
  const auto thrown = static_cast<double>(kept.size());
  kept.erase(std::remove(kept.begin(), kept.end(), 0.0), kept.end());
  const double share = static_cast<double>(kept.size()) / thrown;
  carlo::Table table({"what is averaged", "estimate", "should be"},
                     {"averaged", "estimate", "exact"});
  table.add_row({"f/g over the kept darts", mean(kept), power_integral});
  table.add_row(
      {"the same times the share kept, which estimates ∫g", mean(kept) * share, power_integral});
  table.add_row({"f/g times ∫g = 1/3, where it is known", mean(kept) / 3, power_integral});
  notebook.say(
      "g = x² is no density: its integral is 1/3. Dividing by g alone is off by 1/∫g. Where ∫g "
      "is not known, the darts estimate it: the share kept is ∫g/((b - a) g_max), and lost darts "
      "that count as zeros include it automatically.");
  notebook.table("unnormalised", table, "What to divide by");
}

}  // namespace

void rejection_experiment(Notebook& notebook) {
  notebook.begin("Rejection samples, used directly");
  notebook.attempt([&] { mistakes(notebook); });
  way_table(notebook);
  std::vector<Curve> curves;
  for (const DartWay& way : rejection_ways()) {
    notebook.attempt([&] {
      Curve curve{way.name, {}};
      carlo::Rng rng = notebook.rng();
      for (const std::int64_t n :
           ladder(64, std::max<std::int64_t>(notebook.options().n / 16, 1024))) {
        curve.runs.push_back(repeat(n, notebook.repetitions(200), Summary::root_mean_square, [&] {
          return Trial{mean(way.draw(n, rng)), power_integral};
        }));
      }
      curves.push_back(curve);
    });
  }
  if (curves.empty()) return;
  notebook.say(
      "Lost darts cost variance as well as time: the second moment of a dart is that of a sample "
      "divided by the share kept. All slopes are -1/2.");
  notebook.charts(error_charts("Darts and inversion", "root mean square error", curves));
}

}  // namespace lab06
