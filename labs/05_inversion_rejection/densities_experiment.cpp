#include "course/report/chart.h"
#include "course/report/format.h"
#include "course/viewer/tiles.h"
#include "experiments.h"
#include "goodness.h"
#include "pictures.h"

#include <fmt/core.h>

#include <array>
#include <cmath>

// Histograms against densities, and the slider that inverts by hand.

namespace lab05 {
namespace {

/// A sampler and its density; the view holds the support, or nearly all of it.
struct Density {
  std::string name;
  View view;
  std::function<double(double)> sample;
  Function pdf;
};

/// Weights with a gap.
constexpr std::array<double, 12> table_weights = {1, 3, 5, 4, 2, 0, 0, 2, 6, 7, 3, 1};

std::vector<Density> densities() {
  return {
      {"exponential, rate 1",
       {0, 8, 1.05},
       [](double u) { return sample_exponential(u, 1); },
       [](double x) { return exponential_pdf(x, 1); }},
      {"line from 1 to 3",
       {0, 1, 1.6},
       [](double u) { return sample_linear(u, 1, 3); },
       [](double x) { return linear_pdf(x, 1, 3); }},
      {"tent, radius 2",
       {-2, 2, 0.55},
       [](double u) { return sample_tent(u, 2); },
       [](double x) { return tent_pdf(x, 2); }},
      {"power, n = 5",
       {0, 1, 6.3},
       [](double u) { return sample_power(u, 5); },
       [](double x) { return power_pdf(x, 5); }},
  };
}

/// Separate from the others, since it takes two exercises.
Density tabulated() {
  const Tabulated1d table(table_weights);
  return {"table of 12 bins",
          {0, 1, 2.6},
          [table](double u) { return table.sample(u); },
          [table](double x) { return table.pdf(x); }};
}

struct Histogram {
  std::vector<double> bars;
  Goodness fit;
};

/// Samples in 48 cells, and one more for everything to the right of the view.
Histogram histogram(const Density& density, std::int64_t n, carlo::Rng rng) {
  constexpr std::size_t cells = 48;
  const double width = (density.view.last - density.view.first) / cells;
  std::vector<std::int64_t> counts(cells + 1);
  for (std::int64_t i = 0; i < n; ++i) {
    const double place = (density.sample(rng.uniform()) - density.view.first) / width;
    if (place >= 0) counts[place < cells ? static_cast<std::size_t>(place) : cells] += 1;
  }
  Histogram result;
  std::vector<double> probabilities;
  double rest = 1;
  for (std::size_t i = 0; i < cells; ++i) {
    const double a = density.view.first + static_cast<double>(i) * width;
    probabilities.push_back(integral_over_cell(density.pdf, a, a + width));
    rest -= probabilities.back();
    result.bars.push_back(static_cast<double>(counts[i]) / (static_cast<double>(n) * width));
  }
  // Beyond the view lies the exponential's tail, or nothing but the rounding of the sum.
  probabilities.push_back(rest > 1e-9 ? rest : 0);
  result.fit = goodness(counts, probabilities, n);
  return result;
}

double seconds_of(const Density& density, carlo::Rng rng) {
  return seconds_a_draw(100'000, [&] { return density.sample(rng.uniform()); });
}

Inverse inverse(const Density& density) {
  Inverse curve{density.name, density.view, density.pdf, {}};
  for (std::size_t i = 0; i <= inverse_steps; ++i)
    curve.x.push_back(density.sample(std::fmin(static_cast<double>(i) / inverse_steps, 0.998)));
  return curve;
}

}  // namespace

void densities_experiment(Notebook& notebook) {
  notebook.begin("Inversion: histograms against densities");
  const std::int64_t n = notebook.options().n;
  carlo::Table table({"density", "N", "cells", "χ²", "p", "time a sample"},
                     {"density", "n", "cells", "chi_square", "p", "seconds"});
  std::vector<std::string> pictures;
  std::vector<Inverse> curves;
  const auto show = [&](const Density& density) {
    const Histogram h = histogram(density, n, notebook.rng());
    table.add_row({density.name, n, static_cast<std::int64_t>(h.fit.freedom) + 1, h.fit.statistic,
                   h.fit.p, carlo::seconds_cell(seconds_of(density, notebook.rng()))});
    const std::string verdict = fmt::format("χ² = {} with {} degrees of freedom, p = {}",
                                            carlo::number_text(h.fit.statistic, 3), h.fit.freedom,
                                            carlo::number_text(h.fit.p, 2));
    pictures.push_back(carlo::histogram_tile(density.name, verdict,
                                             {density.view.first, density.view.last},
                                             density.view.top, h.bars, density.pdf));
    curves.push_back(inverse(density));
  };
  double step = 0;
  for (const Density& density : densities()) {
    notebook.progress(step++, 5);
    notebook.attempt([&] { show(density); });
  }
  notebook.attempt([&] { show(tabulated()); });
  if (pictures.empty()) return;
  notebook.say(
      "Bars: how many of N samples fell into each of 48 cells. Line: the density that belongs to "
      "the sampler. The χ² test compares each bar with the density's integral over its cell; "
      "cells where fewer than 100 samples are expected are pooled with their neighbours.");
  notebook.table("densities", table, "Samples against the integrals of their densities");
  notebook.raw_html(carlo::tiles(pictures, 19));
  notebook.say(
      "Inversion by hand: u chooses a height, and the curve of all samples, which is the CDF, says "
      "which x belongs to it. The shaded area under the density is u.");
  notebook.raw_html(inverse_slider(curves));
  notebook.script(carlo::slider_script());
}

}  // namespace lab05
