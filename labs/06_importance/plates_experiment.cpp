#include "course/viewer/tiles.h"
#include "experiments.h"
#include "importance.h"
#include "pictures.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <vector>

// Two techniques, each failing where the other is good, and both together.

namespace lab06 {
namespace {

// Veach's plates in one dimension. Directions are numbers x; four lights of equal power lie along
// the line, from a point to a panel; four plates reflect, from nearly mirror-like to nearly matt. A
// pixel looks in the mirror direction m and sees the lights blurred by the plate's lobe around m.

struct Light {
  double centre, half_width;
  double radiance() const { return 1 / (2 * half_width); }
};

constexpr std::array<Light, 4> plate_lights = {
    {{0.125, 0.0008}, {0.375, 0.005}, {0.625, 0.025}, {0.86, 0.09}}};
/// The scales of the plates' lobes.
constexpr std::array<double, 4> plate_scales = {0.0006, 0.003, 0.012, 0.05};

double radiance(double x) {
  double sum = 0;
  for (const Light& light : plate_lights)
    sum += std::abs(x - light.centre) < light.half_width ? light.radiance() : 0;
  return sum;
}

/// The integral of the lobe from minus infinity to x.
double logistic_cdf(double x, double centre, double scale) {
  return 1 / (1 + std::exp(-(x - centre) / scale));
}

/// The radiance from direction x times the lobe of the plate around m.
Function plate_integrand(double m, double scale) {
  const Density lobe = logistic_density(m, scale);
  return [lobe](double x) {
    const double light = radiance(x);
    return light > 0 ? light * lobe.pdf(x) : 0;
  };
}

/// Its integral.
double plate_exact(double m, double scale) {
  double sum = 0;
  for (const Light& light : plate_lights) {
    const double from = light.centre - light.half_width, to = light.centre + light.half_width;
    // Uses the side of the lobe where both values are small, so that no digits are lost.
    const double part =
        from > m ? logistic_cdf(2 * m - from, m, scale) - logistic_cdf(2 * m - to, m, scale)
                 : logistic_cdf(to, m, scale) - logistic_cdf(from, m, scale);
    sum += light.radiance() * part;
  }
  return sum;
}

/// The two techniques: choose a light, then a point on it; or draw a direction from the lobe.
Density light_technique() {
  constexpr auto count = static_cast<double>(plate_lights.size());
  return {[](double u) {
            const auto i = static_cast<std::size_t>(u * count);
            const Light& light = plate_lights.at(i);
            const double place = u * count - static_cast<double>(i);
            return light.centre + (2 * place - 1) * light.half_width;
          },
          [](double x) { return radiance(x) / count; }};
}

Density lobe_technique(double m, double scale) {
  return logistic_density(m, scale);
}

/// A pixel's estimate from `samples` samples in all.
struct PlateWay {
  std::string name;
  std::function<double(double m, double scale, std::int64_t samples, carlo::Rng& rng)> pixel;
};

std::vector<PlateWay> plates_ways() {
  const auto one = [](const Density& p, double m, double scale, std::int64_t samples,
                      carlo::Rng& rng) {
    double sum = 0;
    for (const double y : contributions(plate_integrand(m, scale), p, samples, rng))
      sum += y;
    return sum / static_cast<double>(samples);
  };
  const auto both = [](Heuristic heuristic) {
    return [heuristic](double m, double scale, std::int64_t samples, carlo::Rng& rng) {
      return multi_sample(plate_integrand(m, scale), {light_technique(), samples / 2},
                          {lobe_technique(m, scale), samples - samples / 2}, heuristic, rng);
    };
  };
  return {{"lights only",
           [=](double m, double scale, std::int64_t samples, carlo::Rng& rng) {
             return one(light_technique(), m, scale, samples, rng);
           }},
          {"lobe only",
           [=](double m, double scale, std::int64_t samples, carlo::Rng& rng) {
             return one(lobe_technique(m, scale), m, scale, samples, rng);
           }},
          {"both, balance", both(balance_weight)},
          {"both, power", both(power_weight)}};
}

constexpr std::size_t columns = 240, rows = 14, gap = 3;
constexpr std::size_t picture_height = plate_scales.size() * (rows + gap) - gap;

double mirror_direction(std::size_t column) {
  return (static_cast<double>(column) + 0.5) / static_cast<double>(columns);
}

/// A photograph's curve: five stops of brightness side by side.
double tone(double radiance) {
  return radiance / (radiance + 4);
}

/// The plates one below the other, the sharpest on top; each row of a plate is a new estimate.
std::string picture(const std::string& title, const std::string& note,
                    const std::function<double(double m, double scale)>& pixel) {
  std::vector<double> values(columns * picture_height);
  for (std::size_t plate = 0; plate < plate_scales.size(); ++plate) {
    for (std::size_t row = 0; row < rows; ++row) {
      for (std::size_t column = 0; column < columns; ++column) {
        const double value = tone(pixel(mirror_direction(column), plate_scales[plate]));
        values[(plate * (rows + gap) + row) * columns + column] = std::isfinite(value) ? value : 1;
      }
    }
  }
  return carlo::image_tile(title, note, carlo::grey_image(values, columns), 1);
}

void images(Notebook& notebook) {
  std::vector<std::string> all;
  for (const PlateWay& way : plates_ways()) {
    if (way.name == "both, balance") continue;
    notebook.attempt([&] {
      carlo::Rng rng = notebook.rng();
      all.push_back(picture(way.name, "4 samples a pixel",
                            [&](double m, double scale) { return way.pixel(m, scale, 4, rng); }));
    });
  }
  all.push_back(picture("Exact", "closed form", plate_exact));
  notebook.raw_html(carlo::tiles(all, 24));
}

/// The relative standard deviation of a pixel with four samples.
double relative_sd(const PlateWay& way, double m, double scale, int repetitions, carlo::Rng rng) {
  const double exact = plate_exact(m, scale);
  double squares = 0;
  for (int i = 0; i < repetitions; ++i) {
    const double off = way.pixel(m, scale, 4, rng) / exact - 1;
    squares += off * off;
  }
  return std::sqrt(squares / repetitions);
}

void spread_table(Notebook& notebook) {
  const std::vector<PlateWay> all = plates_ways();
  carlo::Table table(
      {"plate's lobe", "light's width", "lights only", "lobe only", "both, balance", "both, power"},
      {"scale", "width", "lights", "lobe", "balance", "power"});
  const int repetitions = notebook.options().quick ? 400 : 4000;
  for (const double scale : plate_scales) {
    for (const std::size_t i : {std::size_t{0}, std::size_t{1}, std::size_t{2}, std::size_t{3}}) {
      const Light& light = plate_lights.at(i);
      std::vector<carlo::Cell> row = {scale, 2 * light.half_width};
      for (const PlateWay& way : all)
        row.emplace_back(relative_sd(way, light.centre, scale, repetitions, notebook.rng()));
      table.add_row(std::move(row));
    }
  }
  notebook.table("plates", table,
                 "Relative standard deviation of a pixel that looks at the middle of a light, four "
                 "samples");
}

void convergence(Notebook& notebook) {
  std::vector<Curve> curves;
  for (const PlateWay& way : plates_ways()) {
    notebook.attempt([&] {
      Curve curve{way.name, {}};
      carlo::Rng rng = notebook.rng();
      for (const std::int64_t samples : ladder(2, notebook.options().quick ? 32 : 512)) {
        double squares = 0, count = 0;
        const Measurement m = repeat(samples, 4, Summary::root_mean_square, [&] {
          squares = count = 0;
          for (const double scale : plate_scales) {
            for (std::size_t column = 0; column < columns; column += 3) {
              const double at = mirror_direction(column);
              const double exact = plate_exact(at, scale);
              const double off = (way.pixel(at, scale, samples, rng) - exact) / (exact + 0.1);
              squares += off * off;
              count += 1;
            }
          }
          return Trial{std::sqrt(squares / count), 0};
        });
        curve.runs.push_back(m);
      }
      curves.push_back(curve);
    });
  }
  if (curves.empty()) return;
  carlo::Table table({"way", "samples a pixel", "error", "time of an image", "slope"},
                     {"way", "samples", "error", "seconds", "slope"});
  for (const Curve& curve : curves) {
    const Measurement& last = curve.runs.back();
    table.add_row({curve.name, last.points, last.error, carlo::seconds_cell(last.seconds),
                   slope_cell(curve.against_points())});
  }
  notebook.table("plates_error", table, "Error of a whole image, relative per pixel");
  notebook.charts(error_charts("Plates", "relative error", curves));
}

/// Weights of the two techniques along x, where the pixel looks just beside the middle of a light.
std::string weight_picture(std::string_view title, std::size_t light_index, std::size_t plate) {
  const Light& light = plate_lights.at(light_index);
  const double scale = plate_scales.at(plate);
  const double m = light.centre - 0.4 * light.half_width;
  const double reach = 1.3 * light.half_width;
  const View view{light.centre - reach, light.centre + reach, 1};
  const Density lights = light_technique(), lobe = lobe_technique(m, scale);
  const Function f = plate_integrand(m, scale);
  const double top = f(m);
  const auto weight = [&](Heuristic heuristic) {
    return [&, heuristic](double x) { return heuristic({1, lights.pdf(x)}, {1, lobe.pdf(x)}); };
  };
  return graph_picture(
      title, fmt::format("lobe {:g}, light {:g} wide", scale, 2 * light.half_width), view,
      {line("f, scaled", "c1", view, [&](double x) { return f(x) / top; }),
       line("weight of a light sample, balance", "c3", view, weight(balance_weight)),
       line("the same, power", "c4", view, weight(power_weight))});
}

}  // namespace

void plates_experiment(Notebook& notebook) {
  notebook.begin("Two techniques: plates and lights");
  notebook.say(
      "Four plates, mirror-like at the top, matt at the bottom, show four lights of equal power, "
      "from a point at the left to a panel at the right. Points on lights are good for small lights "
      "and matt plates; directions from the plate's lobe are good for large lights and shiny "
      "plates. Each is hopeless in the other's corner. Weights let every sample count for as much "
      "as its technique is worth there.");
  images(notebook);
  notebook.progress(1, 3);
  notebook.attempt([&] {
    const std::string first = weight_picture("Shiny plate, large light: the lobe decides", 3, 1);
    notebook.raw_html(
        carlo::tiles({first, weight_picture("Both alike: shared", 2, 2),
                      weight_picture("Matt plate, small light: the light decides", 0, 3)},
                     18));
  });
  notebook.attempt([&] { spread_table(notebook); });
  notebook.progress(2, 3);
  convergence(notebook);
}

}  // namespace lab06
