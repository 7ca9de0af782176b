#include "course/cli/source_folder.h"
#include "course/report/stopwatch.h"
#include "image/exr.h"
#include "practice.h"
#include "scene/load_scene.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace lab09 {
namespace {

carlo::Scene practice_scene(const std::string& name, const carlo::Image& image) {
  return carlo::load_scene(
      carlo::source_folder() / "common/scenes" / (name + ".xml"),
      {{"width", std::to_string(image.width)}, {"height", std::to_string(image.height)}});
}

/// Halves width and height: takes means of 2 x 2 pixels, or for standard errors a quarter of the
/// sum in quadrature.
carlo::Image halved(const carlo::Image& image, bool errors) {
  carlo::Image half(image.width / 2, image.height / 2);
  for (int y = 0; y < half.height; ++y) {
    for (int x = 0; x < half.width; ++x) {
      Rgb sum(0);
      for (int i = 0; i < 4; ++i) {
        const Rgb one = image.at(2 * x + i % 2, 2 * y + i / 2);
        sum += errors ? one * one : one;
      }
      half.at(x, y) = errors ? glm::sqrt(sum) / 4.0f : sum / 4.0f;
    }
  }
  return half;
}

carlo::Image practice_reference(const std::string& name, bool errors, int most) {
  const carlo::ExrFile file = carlo::read_exr(CARLO_LAB09_REFERENCES "/" + name + ".exr");
  carlo::Image image = errors ? file.standard_error.value() : file.image;
  while (image.width > most)
    image = halved(image, errors);
  return image;
}

PracticeRun practice_run(Notebook& notebook, const PracticeScene& scene,
                         const PracticeMethod& method, int passes, int repetitions) {
  PracticeRun run;
  run.passes = passes;
  std::vector<carlo::Image> images;
  const carlo::Stopwatch watch;
  for (int i = 0; i < repetitions; ++i)
    images.push_back(method.render(passes, notebook.rng().next_u64()));
  run.seconds = watch.seconds() / repetitions;
  run.parts = practice_parts(scene, images);
  run.shown = std::move(images.front());
  return run;
}

/// The time of a number of passes: some seconds once, and some for each.
struct PassCost {
  double once = 0, each = 0;

  int passes_in(double seconds) const {
    return std::max(2, static_cast<int>(std::lround((seconds - once) / each)));
  }
};

PassCost cost_of_passes(Notebook& notebook, const PracticeMethod& method) {
  const auto seconds_of = [&](int passes) {
    const carlo::Stopwatch watch;
    method.render(passes, notebook.rng().next_u64());
    return watch.seconds();
  };
  int passes = 2;
  while (seconds_of(passes) < 0.05)
    passes *= 2;
  const double few = seconds_of(passes), more = seconds_of(2 * passes);
  const double each = std::max(more - few, more / 8) / passes;
  return {std::max(few - passes * each, 0.0), each};
}

}  // namespace

PracticeScene::PracticeScene(const std::string& scene_name, int most)
    : name(scene_name),
      reference(practice_reference(name, false, most)),
      reference_error(practice_reference(name, true, most)),
      world(practice_scene(name, reference)) {}

Ray PracticeScene::ray(int x, int y, Vec2 jitter) const {
  const carlo::Scene& scene = world.scene();
  return scene.camera.ray({(static_cast<float>(x) + jitter.x) / static_cast<float>(scene.width),
                           (static_cast<float>(y) + jitter.y) / static_cast<float>(scene.height)});
}

ImageParts practice_parts(const PracticeScene& scene, const std::vector<carlo::Image>& images) {
  const auto count = 3 * static_cast<double>(scene.reference.pixels.size());
  const auto n = static_cast<double>(images.size());
  ImageParts sum;
  double bias_variance = 0;
  std::vector<double> values(images.size());
  for (std::size_t i = 0; i < scene.reference.pixels.size(); ++i) {
    double pixel_variance = 0;
    for (int c = 0; c < 3; ++c) {
      for (std::size_t k = 0; k < images.size(); ++k)
        values[k] = static_cast<double>(images[k].pixels[i][c]);
      const auto exact = static_cast<double>(scene.reference.pixels[i][c]);
      const auto error = static_cast<double>(scene.reference_error.pixels[i][c]);
      const ErrorParts parts = split_error(values, exact);
      const double unit = count * (exact * exact + 0.01);
      sum.bias2 += (parts.bias2 - error * error) / unit;
      pixel_variance += parts.variance / unit;
    }
    sum.variance += pixel_variance;
    // Without bias, bias2 is the mean of products of two errors, over all pairs of images: its
    // variance is 2 sigma^4/(n (n - 1)); and s^4 is sigma^4 (n + 1)/(n - 1) on average.
    bias_variance += 2 * pixel_variance * pixel_variance / (n * (n + 1));
  }
  sum.bias_error = std::sqrt(bias_variance);
  return sum;
}

carlo::Image mean_of_passes(int passes, const std::function<carlo::Image(int number)>& pass) {
  std::vector<carlo::Image> images(static_cast<std::size_t>(passes));
  tbb::parallel_for(0, passes, [&](int i) { images[static_cast<std::size_t>(i)] = pass(i); });
  carlo::Image mean = images.front();
  for (std::size_t i = 0; i < mean.pixels.size(); ++i) {
    glm::dvec3 sum(0);
    for (const carlo::Image& image : images)
      sum += image.pixels[i];
    mean.pixels[i] = sum / static_cast<double>(passes);
  }
  return mean;
}

double PracticeCurve::slope() const {
  std::vector<double> seconds, errors;
  for (const PracticeRun& run : runs) {
    seconds.push_back(run.seconds);
    errors.push_back(std::max(run.rel_mse(), std::numeric_limits<double>::min()));
  }
  return std::max(fitted_slope(seconds, errors), -1.0);
}

double PracticeCurve::predicted(double t) const {
  const PracticeRun& last = longest();
  switch (trend) {
    case Trend::unbiased:
      return last.parts.variance * last.seconds / t;
    case Trend::biased:
      return last.parts.bias_at_most() + last.parts.variance * last.seconds / t;
    case Trend::consistent:
      return last.rel_mse() * std::pow(t / last.seconds, slope());
  }
  return 0;
}

PracticeCurve measure_practice(Notebook& notebook, const PracticeScene& scene,
                               const PracticeMethod& method, double seconds) {
  PracticeCurve curve{method.name, method.trend, {}};
  const PassCost cost = cost_of_passes(notebook, method);
  for (const int share : {16, 4, 1}) {
    const int passes = cost.passes_in(seconds / share);
    if (!curve.runs.empty() && passes == curve.longest().passes) continue;
    curve.runs.push_back(practice_run(notebook, scene, method, passes,
                                      share == 1   ? 2
                                      : share == 4 ? 3
                                                   : 4));
  }
  return curve;
}

double overtaking(const PracticeCurve& unbiased, const PracticeCurve& other) {
  const double a = unbiased.longest().parts.variance * unbiased.longest().seconds;
  const PracticeRun& last = other.longest();
  if (other.trend != Trend::consistent) {
    const double bias2 = other.trend == Trend::biased ? last.parts.bias_at_most() : 0;
    return overtakes_after(a, last.parts.variance * last.seconds, bias2);
  }
  // a/t = p t^slope
  const double slope = other.slope();
  const double p = last.rel_mse() / std::pow(last.seconds, slope);
  if (slope <= -1) return a < p ? 0 : std::numeric_limits<double>::infinity();
  return std::pow(a / p, 1 / (1 + slope));
}

}  // namespace lab09
