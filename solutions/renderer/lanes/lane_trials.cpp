#include "image/image.h"
#include "random/hash.h"
#include "render/driver.h"
#include "renderer/lanes/lane_integrator.h"
#include "renderer/lanes/lane_kernel.h"
#include "renderer/lanes/lane_scene.h"
#include "scene/scene.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace renderer {
namespace {

using Means = std::vector<std::array<double, 3>>;

constexpr std::uint32_t blocks = 8, samples = 16;  ///< per pixel, and per block
/// The factor by which sharing must seem better, since it costs a little more than its rays.
constexpr double least_gain_of_sharing = 1.1;
/// Each technique tries one in this many of a render's paths.
constexpr double share = 512;
/// The relative cost of a ray when light paths are traced, too (without mirrors, glass and the
/// like).
constexpr double ray_cost = 1.3;
/// The factor by which light paths must seem better, since so short a trial may mislead. With
/// mirrors or glass, which focus light, or lobes, which do so a little, they are expected to be.
constexpr double least_gain = 2.3, least_gain_with_lobes = 1, least_gain_with_mirrors = 0.8;

/// A render learns where light is from one in this many of its paths, from at most `most_lessons`,
/// and not at all if that leaves less than `least_lessons`. The first ones decide whether to go on.
constexpr double lesson_share = 16;
constexpr double least_lessons = 1 << 14, most_lessons = 1 << 18, first_lessons = 1 << 13;
/// The first lessons must gain what all cost: a lesson that of some paths, with what guided paths
/// take longer, and a guide that of some lessons.
constexpr double lesson_cost = 3, guide_cost = 8000;

struct Trial {
  Means mean, variance;  ///< over the pixels of a block
  double rays = 0;
  /// By light paths: what the luminance's variance is at least without them.
  std::vector<double> least_variance_without = {};
};

/// Sets the mean and the variance of pixel i.
void add(std::span<const std::array<double, 3>> of_blocks, Trial& trial, std::size_t i) {
  for (std::size_t c = 0; c < 3; ++c) {
    double sum = 0, squares = 0;
    for (const auto& mean : of_blocks)
      sum += mean[c] / blocks, squares += mean[c] * mean[c] / blocks;
    trial.mean[i][c] = sum, trial.variance[i][c] = squares - sum * sum;
  }
}

class Pilot {
 public:
  Pilot(const carlo::Scene& scene, const LaneScene& lanes, std::uint64_t seed, int side)
      : scene_(scene), lanes_(lanes), seed_(seed), side_(side) {}

  Trial run(bool light_paths) const {
    const LaneChoices choices{.light_paths = light_paths ? 1.0f : 0.0f};
    carlo::Counts counts;
    Trial trial{Means(pixels()), Means(pixels())};
    std::vector<Means> images;
    std::vector<double> squares(pixels());  // of CameraMoment, a sample
    for (std::uint32_t b = 0; b < blocks; ++b)
      images.push_back(render(b, choices, counts, squares));
    for (std::size_t i = 0; i < pixels(); ++i) {
      std::array<std::array<double, 3>, blocks> of_blocks;
      for (std::uint32_t b = 0; b < blocks; ++b)
        of_blocks[b] = images[b][i];
      add(of_blocks, trial, i);
      const double mean = carlo::luminance(trial.mean[i]);
      trial.least_variance_without.push_back((squares[i] - mean * mean) / samples);
    }
    trial.rays = static_cast<double>(counts.rays);
    return trial;
  }

 private:
  std::size_t pixels() const {
    return static_cast<std::size_t>(side_) * static_cast<std::size_t>(side_);
  }

  Means render(std::uint32_t block, const LaneChoices& choices, carlo::Counts& counts,
               std::vector<double>& squares) const {
    const carlo::Tile tile{0, 0, side_, side_, block * samples, samples, 0};
    const LaneJob job{lanes_, scene_.camera, side_, side_,  scene_.max_depth,
                      seed_,  lanes_.sobol,  tile,  choices};
    Means means(pixels());
    render_lanes(job, means, counts);
    if (choices.light_paths == 0) return means;
    const std::uint64_t count = std::uint64_t{samples} * pixels();
    carlo::Splats splats(pixels(), lanes_.splat_unit(count));
    std::vector<CameraMoment> moments;
    trace_light_paths({job, block * count, count, splats.unit(), &moments}, splats, counts);
    std::ranges::sort(moments, {}, &CameraMoment::order);  // lanes end in any order
    const double all = static_cast<double>(count) * static_cast<double>(pixels()) * blocks;
    for (const CameraMoment& moment : moments)
      squares[moment.pixel] += static_cast<double>(moment.root) * moment.root / all;
    for (std::size_t i = 0; i < pixels(); ++i) {
      for (std::size_t c = 0; c < 3; ++c)
        means[i][c] += splats.sum(i, c) / static_cast<double>(count);
    }
    return means;
  }

  const carlo::Scene& scene_;
  const LaneScene& lanes_;
  std::uint64_t seed_;
  int side_;
};

/// The mean over pixels of the squared relative error; leaves out pixels far darker than the mean.
double relative_variance(const Trial& trial, const Means& means) {
  double whole = 0, sum = 0;
  for (const auto& mean : means)
    whole += carlo::luminance(mean) / static_cast<double>(means.size());
  for (std::size_t i = 0; i < means.size(); ++i) {
    const double floor = 0.01 * whole, mean = carlo::luminance(means[i]);
    sum += carlo::luminance(trial.variance[i]) / (mean * mean + floor * floor);
  }
  return sum;
}

/// Decides by short renders of few pixels how to render a scene, by the relative variance of a
/// pixel times the number of rays. The same seed and number of samples give the same answers.
class Decision {
 public:
  Decision(const carlo::Scene& scene, const LaneScene& lanes, std::uint64_t seed, std::uint32_t spp)
      : scene_(scene),
        lanes_(lanes),
        seed_(seed),
        spp_(spp),
        paths_(static_cast<double>(scene.width) * scene.height * spp),
        pilot_(scene, lanes, seed, side_of(paths_ / share / (blocks * samples), 8)) {}

  /// True if there should be light paths. Always so where points
  /// shine on mirrors or glass: other paths miss that light. Traces about 0.6 % as many paths as
  /// the render, and at least 25000.
  bool light_paths() {
    if (!lanes_.has_path_starts()) return false;
    if (lanes_.point_lights() && lanes_.any_specular) return true;
    Trial without = pilot_.run(false);
    const Trial with = pilot_.run(true);
    for (std::size_t i = 0; i < with.mean.size(); ++i) {
      // In luminance alone, as relative_variance() reads it.
      const double least_variance = with.least_variance_without[i];
      if (carlo::luminance(without.variance[i]) < least_variance)
        without.variance[i].fill(least_variance);
    }
    const double cost = lanes_.full() ? 1 : ray_cost;
    const double least = lanes_.any_specular ? least_gain_with_mirrors
                         : lanes_.phong      ? least_gain_with_lobes
                                             : least_gain;
    // The better image serves both, so that light that one of them missed does not look dark.
    return gain(without, with, with.mean) > least * cost;
  }

  /// True if pixels should share what paths find. Blocks of one sample do not tell by how much
  /// their errors are alike.
  bool sharing(const LaneChoices& choices) const {
    if (choices.light_paths > 0 || !lanes_.can_share() || carlo::block_size(spp_) < 2) return false;
    if (scene_.max_depth == 2) return false;
    LaneChoices shared = choices;
    shared.share = true;
    constexpr double square_share = 1 << 17;
    const double root = std::ceil(std::sqrt(paths_ / square_share));
    const int side = static_cast<int>(std::clamp(root, 1.0, 4.0));
    const std::vector<carlo::Tile> squares = some_tiles(side, carlo::sharing_pixels);
    const Trial without = try_tiles(squares, choices), with = try_tiles(squares, shared);
    return typical_gain(without, with) > least_gain_of_sharing;
  }

  /// Where paths find light, if it pays to be guided by it. Traces up to a sixteenth as many paths
  /// as the render, and at most 2^18; a 64th if it does not pay, none for a short render.
  std::optional<Guide> guide(Guidance guidance, const LaneChoices& choices) const {
    const double lessons = std::min(paths_ / lesson_share, most_lessons);
    const bool always = guidance == Guidance::always;
    if (guidance == Guidance::none || (!always && lessons < least_lessons)) return std::nullopt;
    // Most of the noise is then that of light paths or shared with them: guidance gains nothing.
    if (!always && choices.light_paths > 0) return std::nullopt;
    const double first = std::max(lessons / 8, first_lessons);
    GuideLearner learner;
    teach(learner, first, choices, 1);
    if (!always) {
      const Guide guide = learner.learn();
      constexpr double pixel_share = 1 << 14;
      const int side = static_cast<int>(std::clamp(std::sqrt(paths_ / pixel_share), 8.0, 16.0));
      const std::vector<carlo::Tile> pixels = some_tiles(side, 1);
      const Trial without = try_tiles(pixels, choices), with = try_tiles(pixels, choices, &guide);
      const double least = (1 + lesson_cost * lessons / paths_) * (1 + guide_cost / lessons);
      if (typical_gain(without, with) < least) return std::nullopt;
    }
    if (lessons > first) teach(learner, lessons - first, choices, 2);
    return learner.learn();
  }

 private:
  static int side_of(double pixels, double least) {
    return static_cast<int>(std::clamp(std::sqrt(pixels), least, 64.0));
  }

  /// How many times less relative variance times rays there is with something than without.
  static double gain(const Trial& without, const Trial& with, const Means& mean) {
    return relative_variance(without, mean) * without.rays /
           (relative_variance(with, mean) * with.rays);
  }

  /// The same by the geometric mean over pixels, each of which has few blocks: the mean would
  /// follow the few with a rare bright path.
  static double typical_gain(const Trial& without, const Trial& with) {
    double sum = 0, count = 0;
    for (std::size_t i = 0; i < with.mean.size(); ++i) {
      const double before = carlo::luminance(without.variance[i]);
      const double after = carlo::luminance(with.variance[i]);
      if (before > 0 && after > 0) sum += std::log(before / after), ++count;
    }
    return count > 0 ? std::exp(sum / count) * without.rays / with.rays : 0;
  }

  /// `side` x `side` squares of this size, spread over the image; their corners are multiples of
  /// the size.
  std::vector<carlo::Tile> some_tiles(int side, int size) const {
    std::vector<carlo::Tile> tiles;
    for (int i = 0; i < side * side; ++i) {
      const std::uint64_t random = carlo::hash(seed_, 3, i);
      const auto at = [&](int part, int length, std::uint64_t word) {
        const double inside = static_cast<double>(word & 0xFFFF) * 0x1p-16;
        return static_cast<int>((part + inside) * length / side) / size * size;
      };
      const int x = at(i % side, scene_.width, random),
                y = at(i / side, scene_.height, random >> 32);
      tiles.push_back({.x0 = x,
                       .y0 = y,
                       .x1 = std::min(x + size, scene_.width),
                       .y1 = std::min(y + size, scene_.height),
                       .samples = samples / 2,
                       .share = true});
    }
    return tiles;
  }

  /// Renders parts of the image by camera paths, others than those of the image.
  Trial try_tiles(const std::vector<carlo::Tile>& tiles, const LaneChoices& choices,
                  const Guide* guide = nullptr) const {
    Trial trial;
    carlo::Counts counts;
    for (const carlo::Tile& tile : tiles) {
      LaneJob of_tile = job(tile, choices, 3, scene_.width, scene_.height);
      of_tile.blocks = blocks;
      of_tile.guide = guide;
      const auto pixels = static_cast<std::size_t>((tile.x1 - tile.x0) * (tile.y1 - tile.y0));
      Means means(blocks * pixels);
      render_lanes(of_tile, means, counts);
      for (std::size_t i = 0; i < pixels; ++i) {
        std::array<std::array<double, 3>, blocks> of_blocks;
        std::copy_n(means.begin() + static_cast<std::ptrdiff_t>(blocks * i), blocks,
                    of_blocks.begin());
        trial.mean.emplace_back(), trial.variance.emplace_back();
        add(of_blocks, trial, trial.mean.size() - 1);
      }
    }
    trial.rays = static_cast<double>(counts.rays);
    return trial;
  }

  void teach(GuideLearner& learner, double lessons, const LaneChoices& choices,
             std::uint64_t number) const {
    constexpr std::uint32_t a_pixel = 64;
    const int side = side_of(lessons / a_pixel, 1);
    const carlo::Tile tile{0, 0, side, side, 0, a_pixel, 0};
    LaneJob lesson = job(tile, choices, number, side, side);
    lesson.learner = &learner;
    Means means(static_cast<std::size_t>(side) * static_cast<std::size_t>(side));
    carlo::Counts counts;
    render_lanes(lesson, means, counts);
  }

  /// Other paths than those of the image, which would be biased otherwise: `number` is not 0.
  LaneJob job(const carlo::Tile& tile, const LaneChoices& choices, std::uint64_t number, int width,
              int height) const {
    return {lanes_,
            scene_.camera,
            width,
            height,
            scene_.max_depth,
            carlo::hash(seed_, 0x6D1DE, number),
            lanes_.sobol,
            tile,
            choices};
  }

  const carlo::Scene& scene_;
  const LaneScene& lanes_;
  std::uint64_t seed_;
  std::uint32_t spp_;
  double paths_;
  Pilot pilot_;
};

}  // namespace

float light_paths_per_path(const LaneScene& lanes) {
  if (lanes.any_specular) return lanes.point_lights() ? 1 : 0.25f;
  return lanes.phong ? 0.5f : 1;
}

std::optional<Guide> decide(const carlo::Scene& scene, const LaneScene& lanes, std::uint64_t seed,
                            const LaneTrials& trials, LaneChoices& choices) {
  if (scene.max_depth == 1) return std::nullopt;  // all that is decided is about longer paths
  Decision decision(scene, lanes, seed, trials.spp);
  if (trials.light_paths)
    choices.light_paths = decision.light_paths() ? light_paths_per_path(lanes) : 0;
  std::optional<Guide> guide = decision.guide(trials.guidance, choices);
  if (trials.share) choices.share = decision.sharing(choices);
  return guide;
}

}  // namespace renderer
