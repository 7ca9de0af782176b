// Lab 8: the path tracer, pixel by pixel, and the furnace in which error bars lie.

#include "given/sampled.h"
#include "recap_room.h"
#include "scenes.h"
#include "stats/running_mean.h"

#include <algorithm>
#include <limits>
#include <memory>

namespace site {
namespace {

using namespace lab08;
using carlo::RunningMean;

/// The tracers, in the order of the pages' menus. The first two are for worlds of Phong surfaces.
enum class Tracer { lecture, recursive, direct, iterative };

/// A render in progress: the mean and spread of each pixel's colour and luminance.
struct Render {
  World world;
  Tracer tracer;
  int size;
  std::uint64_t seed;
  int max_depth;
  struct Pixel {
    glm::dvec3 sum{0};
    RunningMean luminance;
  };
  std::vector<Pixel> pixels;

  /// From the scene's number, then tracer, size, seed and longest path.
  explicit Render(const Arguments& given)
      : world(scene_with_film(given.index(0), static_cast<int>(given[2]))),
        tracer(static_cast<Tracer>(given.whole(1))),
        size(static_cast<int>(given[2])),
        seed(static_cast<std::uint64_t>(given[3])),
        max_depth(static_cast<int>(given[4])),
        pixels(given.index(2) * given.index(2)) {}

  Rgb sample(int x, int y, std::uint32_t index) const {
    const auto pixel = static_cast<std::uint32_t>(y * size + x);
    Sampled<carlo::IndependentSampler> numbers({seed, pixel, index, 1});
    const Vec2 jitter = numbers.next_2d();
    const auto side = static_cast<float>(size);
    const Ray ray = world.scene().camera.ray(
        {(static_cast<float>(x) + jitter.x) / side, (static_cast<float>(y) + jitter.y) / side});
    if (tracer == Tracer::iterative) return path_radiance(world, ray, max_depth, numbers);
    Rng rng(carlo::hash(seed, pixel), index);
    if (tracer == Tracer::lecture) return trace_path_lecture(world, ray, rng);
    return tracer == Tracer::recursive ? trace_path(world, ray, rng)
                                       : trace_specular(world, ray, true, rng);
  }

  const Pixel& pixel(std::size_t x, std::size_t y) const {
    return pixels[y * static_cast<std::size_t>(size) + x];
  }

  void add_row(int y) {
    for (int x = 0; x < size; ++x) {
      Pixel& pixel = pixels[static_cast<std::size_t>(y * size + x)];
      const auto index = static_cast<std::uint32_t>(pixel.luminance.count());
      const glm::dvec3 colour(sample(x, y, index));
      pixel.sum += colour;
      // ITU-R BT.709.
      pixel.luminance.add(0.2126 * colour.r + 0.7152 * colour.g + 0.0722 * colour.b);
    }
  }
};

std::vector<std::unique_ptr<Render>> renders;

Render& render_of(const Arguments& given) {
  return *renders.at(given.index(0));
}

/// scene, tracer, size, seed, longest path (0: as long as it takes), number of the render (it
/// replaces the one of that number).
Numbers start(const Arguments& given) {
  renders.resize(std::max(renders.size(), given.index(5) + 1));
  renders[given.index(5)] = std::make_unique<Render>(given);
  return {};
}

/// render, first row, rows: one more sample in each of their pixels.
Numbers rows(const Arguments& given) {
  Render& render = render_of(given);
  for (std::int64_t y = given.whole(1); y < given.whole(1) + given.whole(2); ++y)
    render.add_row(static_cast<int>(y));
  return {};
}

/// render: the mean colours of its pixels, row by row; black where there are no samples.
Numbers image(const Arguments& given) {
  Numbers rgb;
  for (const Render::Pixel& pixel : render_of(given).pixels) {
    const double n = std::max(1.0, pixel.luminance.count());
    rgb.insert(rgb.end(), {pixel.sum.r / n, pixel.sum.g / n, pixel.sum.b / n});
  }
  return rgb;
}

/// The mean luminance of a block of 8 x 8 pixels, the first at (left, top).
double block_mean(const Render& render, std::size_t left, std::size_t top) {
  double sum = 0;
  for (std::size_t i = 0; i < 64; ++i)
    sum += render.pixel(left + i % 8, top + i / 8).luminance.mean();
  return sum / 64;
}

/// The mean of the squared standard errors of the same pixels.
double block_error(const Render& render, std::size_t left, std::size_t top) {
  double sum = 0;
  for (std::size_t i = 0; i < 64; ++i) {
    const RunningMean& luminance = render.pixel(left + i % 8, top + i / 8).luminance;
    const double error = luminance.count() < 2 ? 0 : luminance.error();
    sum += error * error;
  }
  return sum / 64;
}

/// render, reference (another render), both of a size that is a multiple of 8: the mean luminance;
/// then the root of the mean, over all pixels, of se^2 / (L^2 + .01), where se is the pixel's
/// standard error and L the luminance of its block in the reference, which is right enough for a
/// denominator: the square root of relMSE; then the same for each row of blocks, whose noise is
/// independent.
Numbers noise(const Arguments& given) {
  const Render &render = render_of(given), &reference = *renders.at(given.index(1));
  const auto blocks = static_cast<std::size_t>(render.size) / 8;
  const auto count = static_cast<double>(blocks);
  double mean = 0, all = 0;
  Numbers groups;
  for (std::size_t y = 0; y < blocks; ++y) {
    double row = 0;
    for (std::size_t x = 0; x < blocks; ++x) {
      const double luminance = block_mean(reference, 8 * x, 8 * y);
      row += block_error(render, 8 * x, 8 * y) / (luminance * luminance + 0.01) / count;
      mean += block_mean(render, 8 * x, 8 * y) / count / count;
    }
    groups.push_back(std::sqrt(row));
    all += row / count;
  }
  Numbers results{mean, std::sqrt(all)};
  results.insert(results.end(), groups.begin(), groups.end());
  return results;
}

/// render: the mean luminance, and the root mean square of the pixels' standard errors.
Numbers deviation(const Arguments& given) {
  double sum = 0, squares = 0;
  const Render& render = render_of(given);
  for (const Render::Pixel& pixel : render.pixels) {
    sum += pixel.luminance.mean();
    const double error = pixel.luminance.count() < 2 ? 0 : pixel.luminance.error();
    squares += error * error;
  }
  const auto count = static_cast<double>(render.pixels.size());
  return {sum / count, std::sqrt(squares / count)};
}

/// render, x, y: samples, mean luminance and its standard error.
Numbers pixel(const Arguments& given) {
  const Render& render = render_of(given);
  const auto& pixel =
      render.pixels[given.index(2) * static_cast<std::size_t>(render.size) + given.index(1)];
  const double n = pixel.luminance.count();
  return {n, pixel.luminance.mean(), n < 2 ? 0 : pixel.luminance.error()};
}

/// A closed sphere that emits 1 and reflects rho: the radiance is 1/(1 - rho) everywhere.
carlo::Scene furnace(double rho) {
  carlo::Scene scene;
  scene.materials = {{carlo::Diffuse{Rgb(static_cast<float>(rho))}, false}};
  scene.shapes = {{carlo::Sphere{{0, 0, 0}, 2, true}, 0, Rgb(1)}};
  return scene;
}

/// rho, rule (0 the lecture's, 1 corrected), N, runs, seed: the RMS error, the share of 95 % error
/// bars that hold the truth, and of the first run mean and standard error after 16, 20, 25 ...
/// paths.
Numbers furnace_runs(const Arguments& given) {
  const World world(furnace(given[0]));
  const auto rule = given[1] == 0 ? trace_path_lecture : trace_path;
  const double exact = 1 / (1 - given[0]);
  Rng rng = given.rng(4, 2);
  Numbers results(2);
  bool first = true;
  const auto run = [&] {
    RunningMean mean;
    double next = 16;
    while (mean.count() < given[2]) {
      mean.add(static_cast<double>(rule(world, {{0, 0, 1}, {0.6f, 0, -0.8f}}, rng).r));
      if (!first || mean.count() < next) continue;
      results.insert(results.end(), {mean.count(), mean.mean(), mean.error()});
      next *= 1.25;
    }
    first = false;
    results[1] += std::abs(mean.mean() - exact) <= 1.96 * mean.error() ? 1 / given[3] : 0;
    return mean.mean();
  };
  results[0] = rms_error(given.whole(3), exact, run);
  return results;
}

/// rho: the standard deviation of one path by the lecture's rule, which may be infinite, and by the
/// corrected one. slides 08:furnace-second-moment.
Numbers furnace_deviations(const Arguments& given) {
  constexpr double p = 0.9;
  const double rho = given[0], mean = 1 / (1 - rho), ratio = rho / (1 - p);
  return {ratio < 1 ? std::sqrt(1 / p / (1 - ratio) - mean * mean)
                    : std::numeric_limits<double>::infinity(),
          std::sqrt((1 + 2 * rho * mean) / (1 - rho) - mean * mean)};
}

/// albedo, the ball's radius, form (0 the Recap as printed, 1 corrected, 2 a random direction as
/// printed), paths of at most 100 calls, seed: mean and standard error; the exact radiance; the
/// mean of each printed form, in closed form (Recap, random direction).
Numbers recap(const Arguments& given) {
  constexpr RecapForm forms[] = {recap_as_printed, recap_mended, random_direction_as_printed};
  const RecapRoom room{given[0], given[1], 0, 1};
  const World world(room.scene());
  Rng rng = given.rng(4, 3);
  RunningMean mean;
  for (std::int64_t i = 0; i < given.whole(3); ++i) {
    const RecapPath path = forms[given.index(2)](world, room.light(), RecapRoom::ray(), 100, rng);
    mean.add(static_cast<double>(path.radiance.r));
  }
  return {mean.mean(), mean.error(), room.exact(), room.recap_mean(), room.random_direction_mean()};
}

const Function functions[] = {
    {"8.start", start},          {"8.rows", rows},
    {"8.image", image},          {"8.noise", noise},
    {"8.deviation", deviation},  {"8.pixel", pixel},
    {"8.furnace", furnace_runs}, {"8.furnace_deviations", furnace_deviations},
    {"8.recap", recap}};

}  // namespace
}  // namespace site
