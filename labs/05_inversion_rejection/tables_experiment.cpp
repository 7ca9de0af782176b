#include "alias.h"
#include "experiments.h"
#include "goodness.h"
#include "inversion_rejection.h"
#include "support/wall_clock.h"

#include <fmt/core.h>

#include <algorithm>

// Discrete numbers from ten to ten million weights.

namespace lab05 {
namespace {

/// Uneven weights without a pattern.
std::vector<double> weights_of(std::int64_t bins, carlo::Rng rng) {
  std::vector<double> weights;
  weights.reserve(static_cast<std::size_t>(bins));
  for (std::int64_t i = 0; i < bins; ++i)
    weights.push_back(rng.uniform());
  return weights;
}

/// The end of the CDF of equal weights when it is summed in float; the exact end is 1.
double float_end(std::int64_t bins) {
  const float share = 1.0f / static_cast<float>(bins);
  float sum = 0;
  for (std::int64_t i = 0; i < bins; ++i)
    sum += share;
  return static_cast<double>(sum);
}

/// How well drawn numbers fit their weights, over 64 groups of neighbours.
template <class Draw>
Goodness fit(const std::vector<double>& weights, std::int64_t n, carlo::Rng rng, const Draw& draw) {
  const std::size_t groups = std::min<std::size_t>(weights.size(), 64);
  const auto group = [&](std::size_t i) { return i * groups / weights.size(); };
  std::vector<double> probabilities(groups);
  double sum = 0;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    probabilities[group(i)] += weights[i];
    sum += weights[i];
  }
  for (double& p : probabilities)
    p /= sum;
  std::vector<std::int64_t> counts(groups);
  for (std::int64_t i = 0; i < n; ++i) {
    const std::size_t drawn = draw(rng.uniform());
    if (drawn < weights.size()) counts[group(drawn)] += 1;
  }
  return goodness(counts, probabilities, n);
}

}  // namespace

void tables_experiment(Notebook& notebook) {
  notebook.begin("Tables: from ten to ten million weights");
  const bool quick = notebook.options().quick;
  const std::int64_t count = quick ? 20'000 : 200'000;
  carlo::Table table({"weights", "built in", "bisection", "p", "alias", "p", "float CDF ends at"},
                     {"weights", "seconds_build", "seconds_bisection", "p_bisection",
                      "seconds_alias", "p_alias", "float_end"});
  carlo::Series bisection{"bisection in the CDF", {}}, alias{"alias table (given)", {}};
  const std::vector<std::int64_t> sizes =
      quick ? std::vector<std::int64_t>{10, 1000, 100'000, 1'000'000}
            : std::vector<std::int64_t>{10, 100, 1000, 10'000, 100'000, 1'000'000, 10'000'000};
  double step = 0;
  for (const std::int64_t bins : sizes) {
    notebook.progress(step++, static_cast<double>(sizes.size()));
    const bool done = notebook.attempt([&] {
      const std::vector<double> weights = weights_of(bins, notebook.rng());
      const carlo::WallClock clock;
      const Discrete discrete(weights);
      const double built = clock.seconds();
      const Alias other(weights);
      const auto by_cdf = [&](double u) { return discrete.sample(u).index; };
      const auto by_alias = [&](double u) { return other.sample(u); };
      const auto seconds_a_number = [&](const auto& draw) {
        carlo::Rng rng = notebook.rng();
        return seconds_a_draw(count, [&] { return draw(rng.uniform()); });
      };
      const double cdf_seconds = seconds_a_number(by_cdf);
      const double alias_seconds = seconds_a_number(by_alias);
      const std::int64_t n = notebook.options().n;
      table.add_row({bins, carlo::seconds_cell(built), carlo::seconds_cell(cdf_seconds),
                     fit(weights, n, notebook.rng(), by_cdf).p, carlo::seconds_cell(alias_seconds),
                     fit(weights, n, notebook.rng(), by_alias).p,
                     carlo::Cell(fmt::format("{:.8f}", float_end(bins)), float_end(bins))});
      bisection.points.push_back({static_cast<double>(bins), cdf_seconds});
      alias.points.push_back({static_cast<double>(bins), alias_seconds});
    });
    if (!done) return;
  }
  notebook.say(
      "Time of one number drawn from n weights, the random number included. Bisection takes log n "
      "steps; in large tables each step waits for memory. An alias table looks up one place, "
      "whatever n is, but its numbers do not grow with u. The p-values are those of χ² tests over "
      "groups of neighbours. Last column: the CDF of n equal weights added up in float, which "
      "should end at 1.");
  notebook.table("tables", table, "Discrete numbers");
  notebook.charts({{"Time of one number",
                    "",
                    {"weights", carlo::Unit::count},
                    {"time of one number", carlo::Unit::seconds},
                    {bisection, alias}}});
}

}  // namespace lab05
