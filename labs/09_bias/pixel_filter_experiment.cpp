#include "course/report/format.h"
#include "course/report/stopwatch.h"
#include "course/viewer/tiles.h"
#include "experiments.h"
#include "images/images.h"
#include "numeric/robust.h"
#include "shown_error.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

// Step b: spokes that are finer than a pixel near their hub, by three filters; and one pixel on an
// edge, which has a closed form, by offsets drawn from the filter and by uniform offsets weighted
// by it.

namespace lab09 {
namespace {

struct NamedFilter {
  const char* name;
  PixelFilter filter;
};
const NamedFilter pixel_filters[] = {
    {"box, radius 0.5", {PixelFilter::Curve::box, 0.5, 0}},
    {"tent, radius 1", {PixelFilter::Curve::tent, 1, 0}},
    {"Gaussian, sigma 0.5, radius 1.5", {PixelFilter::Curve::gaussian, 1.5, 0.5}}};

/// Where a ray passes a film of size x size pixels, in pixels from its middle.
Vec2 on_film(const Ray& ray, int size) {
  return Vec2(ray.d.x, ray.d.y) * (static_cast<float>(size) / 2 / -ray.d.z);
}

// Spokes ------------------------------------------------------------------------------------------

constexpr int spokes = 64;

/// White spokes on black, as wide as the gaps between them.
Radiance spokes_on(int size) {
  return [size](const Ray& ray) {
    const Vec2 p = on_film(ray, size);
    return Rgb(std::sin(static_cast<float>(spokes) * std::atan2(p.y, p.x)) > 0 ? 1.0f : 0.0f);
  };
}

/// The remaining contrast of the spokes where one of them and a gap together take this many pixels:
/// the deviation of the pixels' values from grey, 1 for black and white.
double contrast(const carlo::Image& image, double from, double to) {
  double squares = 0;
  int pixels = 0;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const double r = std::hypot(x + 0.5 - image.width / 2.0, y + 0.5 - image.height / 2.0);
      const double period = 2 * carlo::pi * r / spokes;
      if (period < from || period > to) continue;
      const double off = 2 * static_cast<double>(image.at(x, y).g) - 1;
      squares += off * off;
      ++pixels;
    }
  }
  return std::sqrt(squares / pixels);
}

void show_spokes(Notebook& notebook) {
  constexpr int size = 128;
  carlo::Camera camera;
  camera.fit_film(size, size);
  const Radiance radiance = spokes_on(size);
  std::vector<std::pair<std::string, carlo::Image>> images;
  images.emplace_back("through the middles", lab08::render(size, size, 0, [&](int x, int y, Rng&) {
                        return radiance(lab08::middle_ray(camera, size, size, x, y));
                      }));
  const int samples = notebook.options().quick ? 256 : 1024;
  for (const NamedFilter& named : pixel_filters) {
    images.emplace_back(
        named.name,
        lab08::render(size, size, notebook.rng().next_u64(), [&](int x, int y, Rng& rng) {
          return filtered_pixel(camera, size, size, x, y, named.filter, samples, radiance, rng);
        }));
  }
  carlo::Table table({"filter", "1 to 1.4 pixels", "2.5 to 3.5 pixels", "5 to 6 pixels"},
                     {"filter", "too_fine", "fine", "coarse"});
  std::vector<std::string> row;
  for (const auto& [name, image] : images) {
    table.add_row({name, carlo::percent_cell(contrast(image, 1, 1.4), 2),
                   carlo::percent_cell(contrast(image, 2.5, 3.5), 2),
                   carlo::percent_cell(contrast(image, 5, 6), 2)});
    row.push_back(carlo::image_tile(
        name,
        &image == &images[0].second ? "one ray a pixel" : fmt::format("{} rays a pixel", samples),
        image, 1));
  }
  notebook.say(
      "Spokes that become finer towards the hub. Where one spoke and one gap take less than two "
      "pixels, 1.4 along a diagonal, no image can show them, and what appears instead, rings and "
      "other spokes, is aliasing. It should be grey.");
  notebook.raw_html(carlo::tiles(row));
  notebook.table("spokes", table,
                 "Contrast that is left where a spoke and a gap take so many pixels: in the first "
                 "column all of it is aliasing");
}

// An edge -----------------------------------------------------------------------------------------

constexpr int edge_film = 8, edge_pixel = 4;
constexpr double edge_at = 0.3;  ///< pixels to the right of the pixel's middle

Rgb beyond_edge(const Ray& ray) {
  const float edge = static_cast<float>(edge_pixel + 0.5 + edge_at - edge_film / 2.0);
  return Rgb(on_film(ray, edge_film).x > edge ? 1.0f : 0.0f);
}

/// The fraction of a filter beyond the edge.
double share_beyond_edge(const PixelFilter& filter) {
  const double r = filter.radius, left = 1 - edge_at / r;
  switch (filter.curve) {
    case PixelFilter::Curve::box:
      return left / 2;
    case PixelFilter::Curve::tent:
      return left * left / 2;
    case PixelFilter::Curve::gaussian: {
      const double unit = filter.sigma * std::sqrt(2.0), kept = std::erf(r / unit);
      return (kept - std::erf(edge_at / unit)) / (2 * kept);
    }
  }
  return 0;
}

/// One of the two ways to filter.
struct PixelWay {
  const char* name;
  decltype(&filtered_pixel) pixel;
};
constexpr PixelWay pixel_ways[] = {{"drawn", filtered_pixel}, {"weighed", weighted_pixel}};

/// Statistics of the pixel with this many rays, over many runs.
struct EdgeRun {
  ErrorParts parts;
  double seconds = 0;  ///< per pixel

  double error() const { return total_error(parts); }
};

EdgeRun edge_run(Notebook& notebook, const PixelFilter& filter, const PixelWay& way, int samples) {
  carlo::Camera camera;
  camera.fit_film(edge_film, edge_film);
  Rng rng = notebook.rng();
  const auto count = static_cast<std::size_t>(2 * notebook.options().n / samples);
  std::vector<double> estimates(std::min<std::size_t>(count, 1 << 17));
  const carlo::Stopwatch watch;
  for (double& estimate : estimates)
    estimate = static_cast<double>(way.pixel(camera, edge_film, edge_film, edge_pixel, edge_pixel,
                                             filter, samples, beyond_edge, rng)
                                       .g);
  const double seconds = watch.seconds() / static_cast<double>(estimates.size());
  return {split_error(estimates, share_beyond_edge(filter)), seconds};
}

void measure_edge(Notebook& notebook) {
  carlo::Table table({"filter", "offsets", "rays", "bias", "noise", "error", "time"},
                     {"filter", "offsets", "rays", "bias", "noise", "error", "seconds"});
  std::vector<Curve> curves;
  double done = 0;
  for (const auto& [name, filter] : pixel_filters) {
    if (filter.curve == PixelFilter::Curve::box) continue;
    for (const PixelWay& way : pixel_ways) {
      Curve curve{
          fmt::format("{}, {}", std::string(name).substr(0, std::string(name).find(',')), way.name),
          {}};
      for (int samples = 1; samples <= 256; samples *= samples < 4 ? 2 : 4) {
        const EdgeRun run = edge_run(notebook, filter, way, samples);
        table.add_row({name, way.name, samples, carlo::number_cell(signed_root(run.parts.bias2), 2),
                       carlo::number_cell(signed_root(run.parts.variance), 2),
                       carlo::number_cell(signed_root(run.parts.bias2 + run.parts.variance), 2),
                       carlo::seconds_cell(run.seconds)});
        curve.runs.push_back({samples, 0, run.error(), run.seconds});
      }
      curves.push_back(curve);
      notebook.progress(1 + ++done, 5);
    }
  }
  notebook.say(fmt::format(
      "One pixel, and an edge {} pixels to the right of its middle, lit beyond. What the pixel "
      "should be has a closed form: the filter's share beyond the edge. Offsets are drawn from "
      "the filter, or uniform in its square and weighted. (A box has equal weights: there both "
      "are the same.)",
      carlo::number_text(edge_at)));
  notebook.numbers("edge", table,
                   fmt::format("A pixel on an edge: bias and noise apart; {}", minus_is_noise));
  std::vector<carlo::Chart> charts =
      carlo::error_charts("A pixel on an edge", "error", curves, false);
  charts[0].title = "A pixel on an edge: error against rays";
  charts[0].x.label = "rays";
  notebook.charts(charts);
}

}  // namespace

void pixel_filter_experiment(Notebook& notebook) {
  notebook.begin("Step b: pixel filters");
  notebook.attempt([&] {
    show_spokes(notebook);
    notebook.progress(1, 5);
    measure_edge(notebook);
  });
}

}  // namespace lab09
