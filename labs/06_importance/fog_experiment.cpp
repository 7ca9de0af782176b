#include "course/viewer/tiles.h"
#include "experiments.h"
#include "importance.h"
#include "pictures.h"

#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <vector>

// A ray through fog past a light source: light that is scattered once towards the camera.

namespace lab06 {
namespace {

/// The ray runs from t = -3, the camera, to t = 9; t = 0 is nearest to the light.
constexpr double first = -3, last = 9, fog = 0.5;

/// Transmittance from the camera to t times the irradiance there.
Function scattered(double height) {
  return [=](double t) {
    return t <= last ? std::exp(-fog * (t - first)) / (height * height + t * t) : 0;
  };
}

double exact(double height) {
  using Rule = boost::math::quadrature::gauss_kronrod<double, 31>;
  const Function f = scattered(height);
  // The peak is `height` wide: pieces that grow by 3 from there.
  double sum = 0, from = 0, to = height / 4;
  while (from < last) {
    const double a = from, b = std::min(to, last);
    sum += Rule::integrate(f, a, b, 5, 1e-13);
    if (-a > first) sum += Rule::integrate(f, std::max(-b, first), -a, 5, 1e-13);
    from = b;
    to *= 3;
  }
  return sum;
}

/// An estimator that uses `samples` samples.
struct FogWay {
  std::string name;
  double samples;
  std::function<double(const Function& f, double height, carlo::Rng& rng)> draw;
};

FogWay alone(const std::string& name, const std::function<Density(double height)>& density) {
  return {name, 1, [=](const Function& f, double height, carlo::Rng& rng) {
            const Density p = density(height);
            return contribution(f, p, p.sample(rng.uniform()));
          }};
}

FogWay one_of_each(const std::string& name, Heuristic heuristic) {
  return {name, 2, [=](const Function& f, double height, carlo::Rng& rng) {
            return multi_sample(f, {exponential_density(fog, first), 1},
                                {light_density(height, first, last), 1}, heuristic, rng);
          }};
}

std::vector<FogWay> fog_ways() {
  return {alone("uniform", [](double) { return uniform_density(first, last); }),
          alone("free path", [](double) { return exponential_density(fog, first); }),
          alone("light's angle", [](double height) { return light_density(height, first, last); }),
          one_of_each("one of each, balance", balance_weight),
          one_of_each("one of each, power", power_weight),
          {"either by chance", 1, [](const Function& f, double height, carlo::Rng& rng) {
             return one_sample(f, exponential_density(fog, first),
                               light_density(height, first, last), 0.5, balance_weight,
                               rng.uniform());
           }}};
}

/// Relative to the integral. Seconds and standard deviation are per estimate.
struct Result {
  double mean = 0, sd = 0, seconds = 0;
};

Result result_of(const FogWay& way, double height, std::int64_t n, carlo::Rng rng) {
  const Function f = scattered(height);
  const double integral = exact(height);
  double sum = 0, squares = 0;
  const auto draw_all = [&] {
    sum = squares = 0;
    for (std::int64_t i = 0; i < n; ++i) {
      const double y = way.draw(f, height, rng) / integral - 1;
      sum += y;
      squares += y * y;
    }
    return sum;
  };
  const double seconds = best_seconds(draw_all);
  const auto count = static_cast<double>(n);
  return {1 + sum / count, std::sqrt(squares / count), seconds / count};
}

constexpr std::array<double, 7> heights = {0.01, 0.03, 0.1, 0.3, 1, 3, 10};

void sweep(Notebook& notebook) {
  const std::int64_t n = notebook.options().n / 16;
  carlo::Table table(
      {"way", "height", "estimates", "mean/exact", "z", "sd of one sample", "time of an estimate",
       "efficiency"},
      {"way", "height", "estimates", "estimate", "z", "relative_sd", "seconds", "efficiency"});
  carlo::Chart chart{
      "Spread against the light's distance",
      "on the left the light's peak dominates, on the right the fog; for two samples times √2",
      {"distance of the light from the ray"},
      {"relative standard deviation of one sample"},
      {}};
  for (const FogWay& way : fog_ways()) {
    carlo::Series series{way.name, {}};
    notebook.attempt([&] {
      for (const double height : heights) {
        const Result r = result_of(way, height, n, notebook.rng());
        const double sd = r.sd * std::sqrt(way.samples);
        series.points.push_back({height, sd});
        if (height == 0.03 || height == 0.3 || height == 3) continue;
        const double z = (r.mean - 1) / (r.sd / std::sqrt(static_cast<double>(n)));
        table.add_row({way.name, height, n, r.mean, carlo::Cell(fmt::format("{:+.1f}", z), z), sd,
                       carlo::seconds_cell(r.seconds), efficiency(r.sd * r.sd, r.seconds)});
      }
    });
    if (!series.points.empty()) chart.series.push_back(series);
  }
  if (chart.series.empty()) return;
  notebook.charts({chart});
  notebook.table("fog", table,
                 "Single scattering; efficiency is 1/(relative variance × time), in 1/s");
  notebook.say(
      "Choosing one technique at random adds the variance of the choice: even where sampling the "
      "light's angle is almost exact, half of the samples go elsewhere and contribute almost "
      "nothing. One sample of each, with the same weights, avoids that variance.");
}

void vacuum(Notebook& notebook) {
  constexpr double height = 0.1;
  const auto f = [](double t) { return 1 / (height * height + t * t); };
  const double right = (std::atan(last / height) - std::atan(first / height)) / height;
  carlo::Table table({"p", "estimate", "exact", "variance"},
                     {"p", "estimate", "exact", "variance"});
  const auto row = [&](const std::string& name, const Density& p) {
    carlo::Rng rng = notebook.rng();
    const Estimate e = summarize(contributions(f, p, 1000, rng));
    table.add_row({name, e.value, right, e.variance});
  };
  row("uniform", uniform_density(first, last));
  row("light's angle", light_density(height, first, last));
  notebook.say(
      "Without fog f is 1/(height² + t²) alone, and your density is proportional to it: "
      "one sample is the answer.");
  notebook.table("vacuum", table, "1000 samples in clear air, the light at 0.1");
}

std::string picture(double height, std::string_view title) {
  const View wide{first, last, 1};
  const double integral = exact(height);
  const Function f = scattered(height);
  const Density light = light_density(height, first, last), path = exponential_density(fog, first);
  double top = 0;
  const Line shape = line("f/∫f", "c1", wide, [&](double t) { return f(t) / integral; });
  for (const carlo::Point& p : shape.points)
    top = std::max(top, p.y);
  const View view{first, last, std::max(1.1 * top, 0.6)};
  return graph_picture(title, fmt::format("light {:g} from the ray", height), view,
                       {shape, line("p of the free path", "c2", view, path.pdf),
                        line("p of the light's angle", "c3", view, light.pdf)});
}

}  // namespace

void fog_experiment(Notebook& notebook) {
  notebook.begin("A light in fog");
  notebook.say(
      "The light that reaches the camera along a ray is an integral over the ray: at each point "
      "t the irradiance, 1/(height² + t²), attenuated by exp(-fog × distance) on its way back. "
      "Two densities suggest themselves, one for each factor. Close to the light one is "
      "hopeless, far from it the other; both together are good in between and never hopeless.");
  notebook.attempt([&] {
    const std::string near = picture(0.1, "Close: the light's peak");
    notebook.raw_html(carlo::tiles(
        {near, picture(3, "Further away: both matter"), picture(10, "Far away: the fog's fall")},
        18));
  });
  notebook.attempt([&] { vacuum(notebook); });
  sweep(notebook);
}

}  // namespace lab06
