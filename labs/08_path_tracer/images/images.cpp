#include "images/images.h"

#include "course/report/format.h"
#include "course/report/stopwatch.h"
#include "course/viewer/tiles.h"

#include <fmt/core.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace lab08 {
namespace {

double mean_square_difference(const carlo::Image& a, const carlo::Image& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.pixels.size(); ++i) {
    const glm::dvec3 d = glm::dvec3(a.pixels[i]) - glm::dvec3(b.pixels[i]);
    sum += glm::dot(d, d);
  }
  return sum / (3 * static_cast<double>(a.pixels.size()));
}

}  // namespace

carlo::Image render(int width, int height, std::uint64_t seed, const Pixel& pixel) {
  carlo::Image image(width, height);
  tbb::parallel_for(0, height, [&](int y) {
    for (int x = 0; x < width; ++x) {
      const std::size_t index = image.index(x, y);
      Rng rng(seed, index);
      image.pixels[index] = pixel(x, y, rng);
    }
  });
  return image;
}

Ray middle_ray(const carlo::Camera& camera, int width, int height, int x, int y) {
  return camera.ray({(static_cast<float>(x) + 0.5f) / static_cast<float>(width),
                     (static_cast<float>(y) + 0.5f) / static_cast<float>(height)});
}

Rgb mean_of(int samples, const std::function<Rgb()>& estimate) {
  glm::dvec3 sum(0);
  for (int i = 0; i < samples; ++i)
    sum += estimate();
  return sum / static_cast<double>(samples);
}

double mean_value(const carlo::Image& image) {
  glm::dvec3 sum(0);
  for (const Rgb& pixel : image.pixels)
    sum += pixel;
  return (sum.r + sum.g + sum.b) / (3 * static_cast<double>(image.pixels.size()));
}

Reference converged(Notebook& notebook, int width, int height, int samples,
                    const SampledPixel& pixel) {
  const auto half = [&] {
    return render(width, height, notebook.rng().next_u64(),
                  [&](int x, int y, Rng& rng) { return pixel(x, y, samples, rng); });
  };
  Reference reference{half()};
  const carlo::Image other = half();
  // The mean of two has a quarter of the variance of their difference.
  reference.variance = mean_square_difference(reference.image, other) / 4;
  for (std::size_t i = 0; i < other.pixels.size(); ++i)
    reference.image.pixels[i] = (reference.image.pixels[i] + other.pixels[i]) / 2.0f;
  return reference;
}

double relative_error(const carlo::Image& image, const Reference& reference) {
  const double square = mean_square_difference(image, reference.image) - reference.variance;
  return std::sqrt(std::max(square, 0.0)) / mean_value(reference.image);
}

double Result::seconds_a_sample() const {
  return curve.runs.back().seconds / static_cast<double>(curve.runs.back().points);
}

int most_samples(const Notebook& notebook) {
  return static_cast<int>(std::max<std::int64_t>(notebook.options().n / 4096, 16));
}

int image_size(const Notebook& notebook, int full) {
  return notebook.options().quick ? full / 2 : full;
}

Result measure(Notebook& notebook, const std::string& name, const Reference& reference,
               int shown_samples, const SampledPixel& pixel) {
  Result result{{name, {}}, {}, {}};
  for (const std::int64_t samples : carlo::ladder(1, most_samples(notebook))) {
    carlo::Image image;
    double seconds = INFINITY, square = 0;
    // Short renders are repeated: the time is the best one, the error that of all.
    const int rounds = samples <= 4 ? 3 : 1;
    for (int round = 0; round < rounds; ++round) {
      const std::uint64_t seed = notebook.rng().next_u64();
      const carlo::Stopwatch watch;
      image = render(
          reference.image.width, reference.image.height, seed,
          [&](int x, int y, Rng& rng) { return pixel(x, y, static_cast<int>(samples), rng); });
      seconds = std::min(seconds, watch.seconds());
      const double round_error = relative_error(image, reference);
      square += round_error * round_error / rounds;
    }
    result.curve.runs.push_back({samples, mean_value(image), std::sqrt(square), seconds});
    if (samples > shown_samples) continue;
    result.shown = std::move(image);
    result.shown_run = result.curve.runs.back();
  }
  return result;
}

std::vector<std::string> pictures_of(const Reference& reference, const std::string& reference_note,
                                     const std::vector<Result>& results, double white) {
  const std::string title = reference.variance == 0 ? "exact" : "reference";
  std::vector<std::string> row = {carlo::image_tile(title, reference_note, reference.image, white)};
  for (const Result& r : results) {
    row.push_back(
        carlo::image_tile(r.curve.name,
                          fmt::format("{} sample{} a pixel: error {}\u00a0%, {}",
                                      r.shown_run.points, r.shown_run.points == 1 ? "" : "s",
                                      carlo::number_text(100 * r.shown_run.error, 3),
                                      carlo::duration_text(r.shown_run.seconds)),
                          r.shown, white));
  }
  return row;
}

carlo::Table results_table() {
  return carlo::Table({"scene", "method", "samples", "mean", "relative error", "time",
                       "1/(error² time)", "slope against N", "slope against time"},
                      {"scene", "method", "samples", "mean", "error", "seconds", "efficiency",
                       "slope_points", "slope_seconds"});
}

void add_rows(carlo::Table& table, const std::string& scene, const std::vector<Result>& results) {
  for (const Result& r : results) {
    const Measurement& last = r.curve.runs.back();
    table.add_row({scene, r.curve.name, last.points, last.estimate, last.error,
                   carlo::seconds_cell(last.seconds), 1 / (last.error * last.error * last.seconds),
                   slope_cell(r.curve.against_points()), slope_cell(r.curve.against_seconds())});
  }
}

void add_charts(Notebook& notebook, const std::string& title, const std::vector<Result>& results) {
  std::vector<Curve> curves;
  for (const Result& r : results)
    curves.push_back(r.curve);
  std::vector<carlo::Chart> charts =
      carlo::error_charts(title, "relative RMS error of the image", curves);
  charts[0].title = title + ": error against samples";
  charts[0].x.label = "samples a pixel";
  notebook.charts(charts);
}

}  // namespace lab08
