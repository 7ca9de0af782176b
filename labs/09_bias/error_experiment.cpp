#include "course/report/format.h"
#include "experiments.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>

// Step a: the simplest removal of noise, and its price. Samples above c count as c. Everything has
// a closed form, shown beside what split_error() finds.

namespace lab09 {
namespace {

/// An estimate with a fat tail: 1/distance^2 from a point over the middle of a disc of radius 1 to
/// points of the disc that are uniform by area. With u uniform, distance^2 = u + height2.
struct Glow {
  double height2;

  double sample(double u) const { return 1 / (u + height2); }
  double largest() const { return 1 / height2; }
  /// The integral of sample(u) over [0, 1).
  double exact() const { return std::log1p(1 / height2); }

  /// Both parts of the square error of the mean of n samples that are clamped to c: samples are
  /// above c for u below `cut`.
  ErrorParts parts(double c, double n) const {
    const double cut = std::clamp(1 / c - height2, 0.0, 1.0);
    const double mean = c * cut + std::log((1 + height2) / (cut + height2));
    const double squares = c * c * cut + 1 / (cut + height2) - 1 / (1 + height2);
    const double bias = mean - exact();
    return {bias * bias, (squares - mean * mean) / n};
  }

  /// The c with the least square error for n samples.
  double best_clamp(double n) const {
    // Ternary search on log c; the error has a single minimum.
    double low = 0, high = std::log(largest());
    const auto error = [&](double x) {
      const ErrorParts p = parts(std::exp(x), n);
      return p.bias2 + p.variance;
    };
    for (int i = 0; i < 100; ++i) {
      const double a = low + (high - low) / 3, b = high - (high - low) / 3;
      (error(a) < error(b) ? high : low) = error(a) < error(b) ? b : a;
    }
    return std::exp((low + high) / 2);
  }
};

constexpr Glow glow{1.0 / 1024};

/// Independent estimates with this many samples each, clamped to c.
std::vector<double> estimates_of(int estimates, int samples, double c, Rng& rng) {
  std::vector<double> values;
  for (int i = 0; i < estimates; ++i) {
    double sum = 0;
    for (int j = 0; j < samples; ++j)
      sum += std::min(glow.sample(rng.uniform()), c);
    values.push_back(sum / samples);
  }
  return values;
}

/// The number of estimates for a split; chosen for the same time with any number of samples.
int estimates_for(const Notebook& notebook, int samples) {
  const std::int64_t budget = 16 * notebook.options().n;
  return static_cast<int>(std::clamp<std::int64_t>(budget / samples, 512, 1 << 16));
}

constexpr int sample_counts[] = {16, 256, 4096};

double square_error(const ErrorParts& parts) {
  return parts.bias2 + parts.variance;
}

/// Charts bias^2, variance and their sum against c, in units of the exact value's square. Returns
/// the tested c with the least measured sum.
double against_clamp(Notebook& notebook, int samples, carlo::Table& table,
                     std::vector<carlo::Chart>& charts) {
  const double unit = glow.exact() * glow.exact();
  carlo::Series bias{"bias²", {}}, variance{"variance", {}}, both{"both", {}},
      seen{"both, measured", {}};
  double best = 0, least = INFINITY;
  for (int i = 0; i <= 16; ++i) {
    const double c = 4 * std::exp2(i / 2.0);  // up to the largest sample
    const ErrorParts exact = glow.parts(c, samples);
    Rng rng = notebook.rng();
    const std::vector<double> estimates =
        estimates_of(estimates_for(notebook, samples), samples, c, rng);
    const ErrorParts measured = split_error(estimates, glow.exact());
    if (square_error(measured) < least) {
      least = square_error(measured);
      best = c;
    }
    bias.points.push_back({c, exact.bias2 / unit});
    variance.points.push_back({c, exact.variance / unit});
    both.points.push_back({c, square_error(exact) / unit});
    seen.points.push_back({c, square_error(measured) / unit});
    table.add_row({samples, c, carlo::number_cell(exact.bias2 / unit),
                   carlo::number_cell(measured.bias2 / unit),
                   carlo::number_cell(exact.variance / unit),
                   carlo::number_cell(measured.variance / unit),
                   carlo::number_cell(square_error(exact) / unit),
                   carlo::number_cell(square_error(measured) / unit)});
  }
  charts.push_back({fmt::format("{} samples", samples),
                    "by closed form, and their sum as measured",
                    {"samples clamped to"},
                    {"part of the square error"},
                    {bias, variance, both, seen}});
  return best;
}

void clamps(Notebook& notebook) {
  carlo::Table table(
      {"samples", "c", "bias²", "measured", "variance", "measured", "both", "measured"},
      {"samples", "c", "bias2", "bias2_measured", "variance", "variance_measured", "both",
       "both_measured"});
  std::vector<carlo::Chart> charts;
  std::vector<double> least;
  for (const int samples : sample_counts) {
    least.push_back(against_clamp(notebook, samples, table, charts));
    notebook.progress(static_cast<double>(charts.size()), 5);
  }
  notebook.charts(charts);
  notebook.data("clamps", table,
                "Bias² and variance of clamped means, over the square of the exact value");
  carlo::Table best(
      {"samples", "best c", "of those tried", "relative error", "of it bias", "not clamped"},
      {"samples", "best", "measured", "error", "bias", "unclamped"});
  for (std::size_t i = 0; i < std::size(sample_counts); ++i) {
    const int samples = sample_counts[i];
    const double c = glow.best_clamp(samples);
    const ErrorParts parts = glow.parts(c, samples);
    best.add_row({samples, carlo::number_cell(c), carlo::number_cell(least[i]),
                  carlo::percent_cell(std::sqrt(square_error(parts)) / glow.exact()),
                  carlo::percent_cell(std::sqrt(parts.bias2) / glow.exact()),
                  carlo::percent_cell(std::sqrt(glow.parts(glow.largest(), samples).variance) /
                                      glow.exact())});
  }
  notebook.table(
      "best_clamps", best,
      "The best c moves with the number of samples: by closed form, and the best of those "
      "tried as measured");
}

/// A way to choose c for a number of samples.
struct Clamping {
  std::string name;
  std::function<double(int samples)> clamp;
};

std::vector<Clamping> clampings() {
  const double tuned = glow.best_clamp(16);
  return {{"not clamped", [](int) { return glow.largest(); }},
          {"c of 16 samples", [tuned](int) { return tuned; }},
          {"best c each time", [](int samples) { return glow.best_clamp(samples); }}};
}

/// Relative errors measured with more and more samples, and in closed form.
struct ErrorRun {
  std::vector<double> samples, measured, exact;
};

ErrorRun error_run(Notebook& notebook, const Clamping& clamping) {
  ErrorRun run;
  for (int samples = 4; samples <= 4096; samples *= 2) {
    const double c = clamping.clamp(samples);
    Rng rng = notebook.rng();
    const std::vector<double> estimates =
        estimates_of(estimates_for(notebook, samples), samples, c, rng);
    run.samples.push_back(samples);
    run.measured.push_back(std::sqrt(square_error(split_error(estimates, glow.exact()))) /
                           glow.exact());
    run.exact.push_back(std::sqrt(square_error(glow.parts(c, samples))) / glow.exact());
  }
  return run;
}

/// Where one curve of errors falls below another for good, on a straight line between two points
/// (logarithmic); 0: it always was; infinity: it is not below at the end.
double crossing(const ErrorRun& run, const ErrorRun& other) {
  std::size_t last = run.samples.size();  // the last point at which it is not below
  for (std::size_t i = 0; i < run.samples.size(); ++i)
    if (run.measured[i] >= other.measured[i]) last = i;
  if (last == run.samples.size()) return 0;
  if (last + 1 == run.samples.size()) return INFINITY;
  const auto ahead = [&](std::size_t i) { return std::log(run.measured[i] / other.measured[i]); };
  const double share = ahead(last) / (ahead(last) - ahead(last + 1));
  return run.samples[last] * std::pow(run.samples[last + 1] / run.samples[last], share);
}

void slopes_and_crossing(Notebook& notebook) {
  carlo::Chart chart{"Error against samples", "as measured", {"samples"}, {"relative error"}, {}};
  carlo::Table slopes(
      {"clamped", "slope from 4 to 64", "from 64 to 4096", "closed form: 4 to 64", "64 to 4096"},
      {"method", "slope_few", "slope_many", "exact_few", "exact_many"});
  std::vector<ErrorRun> runs;
  for (const Clamping& clamping : clampings()) {
    runs.push_back(error_run(notebook, clamping));
    const ErrorRun& run = runs.back();
    carlo::Series series{clamping.name, {}};
    for (std::size_t i = 0; i < run.samples.size(); ++i)
      series.points.push_back({run.samples[i], run.measured[i]});
    chart.series.push_back(series);
    const auto slope = [&](const std::vector<double>& errors, std::size_t from, std::size_t count) {
      const double s = fitted_slope(std::span(run.samples).subspan(from, count),
                                    std::span(errors).subspan(from, count));
      return carlo::number_cell(s);
    };
    slopes.add_row({clamping.name, slope(run.measured, 0, 5), slope(run.measured, 4, 7),
                    slope(run.exact, 0, 5), slope(run.exact, 4, 7)});
    notebook.progress(3 + static_cast<double>(runs.size()) * 2 / 3, 5);
  }
  notebook.charts({chart});
  notebook.table("clamp_slopes", slopes, "Slopes by fitted_slope()");
  // One sample is one unit of time, so the square error of n samples is a/n or bias^2 + b/n.
  const double tuned = glow.best_clamp(16);
  const double a = glow.parts(glow.largest(), 1).variance;
  const ErrorParts one = glow.parts(tuned, 1);
  Rng rng = notebook.rng();
  const std::vector<double> estimates = estimates_of(estimates_for(notebook, 16), 16, tuned, rng);
  const ErrorParts at_16 = split_error(estimates, glow.exact());
  const double measured = crossing(runs[0], runs[1]);
  carlo::Table table({"overtakes after", "samples"}, {"from", "samples"});
  table.add_row(
      {"by closed form", carlo::number_cell(overtakes_after(a, one.variance, one.bias2))});
  table.add_row({"predicted from estimates by 16 samples",
                 carlo::number_cell(overtakes_after(a, 16 * at_16.variance, at_16.bias2))});
  table.add_row({"where the measured errors cross", carlo::number_cell(measured)});
  notebook.table("clamp_overtaken", table,
                 "When samples that are not clamped overtake those that were clamped for 16");
}

}  // namespace

void error_experiment(Notebook& notebook) {
  notebook.begin("Step a: bias and noise apart");
  notebook.say(fmt::format(
      "Light of a glowing disc of radius 1 close to a point, {} above its middle: points of the "
      "disc, uniform by area, contribute 1/distance², which is {} right below and seldom that "
      "large; the mean is {}. Clamping samples to c reduces the noise, and makes the result too "
      "dark.",
      carlo::number_text(std::sqrt(glow.height2), 3), carlo::number_text(glow.largest()),
      carlo::number_text(glow.exact())));
  notebook.attempt([&] {
    clamps(notebook);
    slopes_and_crossing(notebook);
  });
}

}  // namespace lab09
