#include "course/report/format.h"
#include "course/report/stopwatch.h"
#include "course/viewer/tiles.h"
#include "experiments.h"
#include "numeric/robust.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

// Surfaces under an image of a sky, by directions that depend on the image and by those that do
// not.

namespace lab07 {
namespace {

constexpr std::size_t width = 64, height = 32;
constexpr std::size_t sun_column = 20, sun_row = 7;

/// A sky that is brighter towards the horizon, a sun of one texel, and dark ground; its texels are
/// 5.6 degrees wide.
std::vector<double> sky() {
  std::vector<double> luminances;
  for (std::size_t k = 0; k < width * height; ++k) {
    const std::size_t row = k / width;
    const double up = std::cos(carlo::pi * (static_cast<double>(row) + 0.5) / height);
    luminances.push_back(up > 0 ? 0.2 + 0.6 * (1 - up) * (1 - up) : 0.03);
  }
  luminances[sun_row * width + sun_column] = 400;
  return luminances;
}

/// The part of the sky that a surface sees.
struct Surface {
  std::string name;
  Vec3 normal;
};

std::vector<Surface> surfaces() {
  const Vec3 sun = direction_at({(sun_column + 0.5) / width, (sun_row + 0.5) / height});
  const float level = std::hypot(sun.x, sun.z);
  return {{"floor", {0, 1, 0}},
          {"wall in the sun", {sun.x / level, 0, sun.z / level}},
          {"wall in the shade", {-sun.x / level, 0, -sun.z / level}}};
}

/// The sky, with the data that the techniques need.
struct Lit {
  std::vector<double> luminances = sky();
  ImageLight light = {luminances, width, height};

  double radiance(Vec3 w) const {
    const Point p = place_of(w);
    return luminances[static_cast<std::size_t>(p.y * height) * width +
                      static_cast<std::size_t>(p.x * width)];
  }
};

/// The irradiance, by 16 x 16 directions in each texel.
double exact_irradiance(const Lit& lit, Vec3 normal) {
  constexpr int fine = 16;
  double sum = 0;
  for (std::size_t row = 0; row < height * fine; ++row) {
    const double top = std::cos(carlo::pi * static_cast<double>(row) / (height * fine)),
                 bottom = std::cos(carlo::pi * static_cast<double>(row + 1) / (height * fine));
    for (std::size_t column = 0; column < width * fine; ++column) {
      const Vec3 w = direction_at({(static_cast<double>(column) + 0.5) / (width * fine),
                                   (static_cast<double>(row) + 0.5) / (height * fine)});
      const auto cosine = static_cast<double>(std::max(0.0f, glm::dot(w, normal)));
      sum += lit.luminances[row / fine * width + column / fine] * cosine * (top - bottom) * 2 *
             carlo::pi / (width * fine);
    }
  }
  return sum;
}

Vec2 two(carlo::Rng& rng) {
  const float x = rng.uniform_float();
  const float y = rng.uniform_float();
  return {x, y};
}

double over(double a, double b) {
  return b > 0 ? a / b : 0;
}

/// One direction's contribution to the irradiance.
using Technique = std::function<double(const Lit& lit, const Frame& frame, carlo::Rng& rng)>;

double cosine_with(const Frame& frame, Vec3 wi) {
  return static_cast<double>(std::max(0.0f, glm::dot(frame.n, wi)));
}

double by_uniform(const Lit& lit, const Frame& frame, carlo::Rng& rng) {
  const Vec3 wi = frame.to_world(sample_uniform_hemisphere(two(rng)));
  return 2 * carlo::pi * cosine_with(frame, wi) * lit.radiance(wi);
}

double by_cosine(const Lit& lit, const Frame& frame, carlo::Rng& rng) {
  return carlo::pi * lit.radiance(frame.to_world(sample_cosine_hemisphere(two(rng))));
}

double by_image(const Lit& lit, const Frame& frame, carlo::Rng& rng) {
  const auto [wi, pdf] = lit.light.sample(two(rng));
  const double cosine = cosine_with(frame, wi);
  return cosine > 0 ? lit.radiance(wi) * cosine / static_cast<double>(pdf) : 0;
}

/// Lab 6.7 with the balance heuristic: each of the two with probability 1/2.
double by_both(const Lit& lit, const Frame& frame, carlo::Rng& rng) {
  const bool image = rng.uniform_float() < 0.5f;
  const Vec3 wi =
      image ? lit.light.sample(two(rng)).wi : frame.to_world(sample_cosine_hemisphere(two(rng)));
  const double cosine = cosine_with(frame, wi);
  const double pdf = (static_cast<double>(lit.light.pdf(wi)) + cosine / carlo::pi) / 2;
  return over(lit.radiance(wi) * cosine, pdf);
}

const std::vector<std::pair<std::string, Technique>>& techniques() {
  static const std::vector<std::pair<std::string, Technique>> all = {
      {"uniform", by_uniform},
      {"cosine-weighted", by_cosine},
      {"by the image", by_image},
      {"both, by the balance heuristic", by_both}};
  return all;
}

constexpr int repetitions = 400;

Measurement measure(const Lit& lit, const Surface& surface, const Technique& technique,
                    std::int64_t count, double exact, carlo::Rng rng) {
  const Frame frame(surface.normal);
  double squares = 0, first = 0;
  const carlo::Stopwatch watch;
  for (int i = 0; i < repetitions; ++i) {
    double sum = 0;
    for (std::int64_t k = 0; k < count; ++k)
      sum += technique(lit, frame, rng);
    const double estimate = sum / static_cast<double>(count);
    if (i == 0) first = estimate;
    squares += (estimate - exact) * (estimate - exact);
  }
  return {count, first, std::sqrt(squares / repetitions) / exact, watch.seconds() / repetitions};
}

std::string pictures(const Lit& lit, carlo::Rng rng) {
  constexpr int drawn = 4096;
  std::vector<double> counts(width * height);
  for (int i = 0; i < drawn; ++i) {
    const Point p = place_of(lit.light.sample(two(rng)).wi);
    counts[static_cast<std::size_t>(p.y * height) * width +
           static_cast<std::size_t>(p.x * width)] += 1;
  }
  const double sun = counts[sun_row * width + sun_column] / drawn;
  return carlo::tiles(
      {carlo::image_tile("the sky", "luminance; the sun's texel is 500 times brighter than white",
                         carlo::grey_image(lit.luminances, width), 0.8),
       carlo::image_tile("drawn from it",
                         fmt::format("{} directions, {} % of them towards the sun", drawn,
                                     carlo::number_text(100 * sun, 3)),
                         carlo::grey_image(counts, width), 6)},
      19);
}

}  // namespace

void light_experiment(Notebook& notebook) {
  notebook.begin("An image as a light");
  notebook.attempt([&] {
    const Lit lit;
    notebook.say(
        "A sky of 64 x 32 texels with a sun of one, which sends more than all the rest. Three "
        "surfaces, and directions of four kinds. Those of the image follow the light and ignore "
        "the cosine; on the wall in the shade most of them are lost behind it. Taking each kind "
        "half of the time, weighted by the balance heuristic of lab 6, is good on all three. "
        "Errors are over 400 estimates, relative to the irradiance, from 64 directions on: with "
        "fewer, most runs by uniform or cosine-weighted directions never meet the sun, and seem "
        "to agree.");
    carlo::Table table({"surface", "technique", "directions", "irradiance", "one estimate",
                        "relative error", "time", "1/(error² time)", "slope against N"},
                       {"surface", "technique", "directions", "exact", "estimate", "error",
                        "seconds", "efficiency", "slope_points"});
    notebook.raw_html(pictures(lit, notebook.rng()));
    double done = 0;
    for (const Surface& surface : surfaces()) {
      const double exact = exact_irradiance(lit, surface.normal);
      std::vector<Curve> curves;
      for (const auto& [name, technique] : techniques()) {
        notebook.progress(done++, 12);
        Curve curve{name, {}};
        for (const std::int64_t count :
             carlo::ladder(64, std::max<std::int64_t>(256, notebook.options().n / 64)))
          curve.runs.push_back(measure(lit, surface, technique, count, exact, notebook.rng()));
        const Measurement& last = curve.runs.back();
        table.add_row({surface.name, name, last.points, exact, last.estimate, last.error,
                       carlo::seconds_cell(last.seconds),
                       1 / (last.error * last.error * last.seconds),
                       slope_cell(curve.against_points())});
        curves.push_back(std::move(curve));
      }
      notebook.charts(carlo::error_charts(surface.name, "relative RMS error", curves));
    }
    notebook.table("light", table, "The irradiance of three surfaces under the sky");
  });
}

}  // namespace lab07
