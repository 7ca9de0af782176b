#include "renderer/lanes/lane_integrator.h"

#include "image/image.h"
#include "random/hash.h"
#include "renderer/lanes/lane_kernel.h"
#include "renderer/lanes/lane_scene.h"
#include "scene/scene.h"
#include "support/error.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <chrono>
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

/// The number of light paths for each path from the camera that costs least relMSE x seconds in
/// `rare_paths`, `cornell_phong` and `caustics`: light that mirrors, glass and lobes focus needs
/// fewer than light that comes through a slit and is everywhere after that. What only light paths
/// find gets as many as camera paths. Powers of two, for Sobol' points.
float light_paths_per_path(const LaneScene& lanes) {
  if (lanes.any_specular) return lanes.point_lights() ? 1 : 0.25f;
  return lanes.phong ? 0.5f : 1;
}

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
      const Trial without = try_guide(choices, nullptr), with = try_guide(choices, &guide);
      const double least = (1 + lesson_cost * lessons / paths_) * (1 + guide_cost / lessons);
      if (gain_by_guide(without, with) < least) return std::nullopt;
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
  static double gain_by_guide(const Trial& without, const Trial& with) {
    double sum = 0, count = 0;
    for (std::size_t i = 0; i < with.mean.size(); ++i) {
      const double before = carlo::luminance(without.variance[i]);
      const double after = carlo::luminance(with.variance[i]);
      if (before > 0 && after > 0) sum += std::log(before / after), ++count;
    }
    return count > 0 ? std::exp(sum / count) * without.rays / with.rays : 0;
  }

  /// Renders some of the image's pixels by camera paths, others than those of the image.
  Trial try_guide(const LaneChoices& choices, const Guide* guide) const {
    constexpr double pixel_share = 1 << 14;
    const int side = static_cast<int>(std::clamp(std::sqrt(paths_ / pixel_share), 8.0, 16.0));
    const auto pixels = static_cast<std::size_t>(side) * static_cast<std::size_t>(side);
    Trial trial{Means(pixels), Means(pixels)};
    carlo::Counts counts;
    for (int i = 0; i < side * side; ++i) {
      const std::uint64_t random = carlo::hash(seed_, 3, i);
      const auto at = [&](int part, int size, std::uint64_t word) {
        const double inside = static_cast<double>(word & 0xFFFF) * 0x1p-16;
        return static_cast<int>((part + inside) * size / side);
      };
      const int x = at(i % side, scene_.width, random);
      const int y = at(i / side, scene_.height, random >> 32);
      const carlo::Tile tile{x, y, x + 1, y + 1, 0, samples / 2, 0};
      LaneJob of_pixel = job(tile, choices, 3, scene_.width, scene_.height);
      of_pixel.blocks = blocks;
      of_pixel.guide = guide;
      std::array<std::array<double, 3>, blocks> of_blocks;
      render_lanes(of_pixel, of_blocks, counts);
      add(of_blocks, trial, static_cast<std::size_t>(i));
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
  double paths_;
  Pilot pilot_;
};

class LaneIntegrator final : public carlo::Integrator {
 public:
  LaneIntegrator(const carlo::Scene& scene, std::uint64_t seed, const LaneChoices& choices,
                 const LaneTrials& trials)
      : scene_(scene), lanes_(scene), seed_(seed), choices_(choices) {
    const float light_paths = light_paths_per_path(lanes_);
    choices_.light_paths *= light_paths;
    if (!trials.any() || scene.max_depth == 1) return;  // light paths have two segments or more
    const auto start = std::chrono::steady_clock::now();
    Decision decision(scene, lanes_, seed, trials.spp);
    if (trials.light_paths) choices_.light_paths = decision.light_paths() ? light_paths : 0.0f;
    guide_ = decision.guide(trials.guidance, choices_);
    seconds_spent_ =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  }

  std::string name() const override {
    std::string text = fmt::format("vector path tracer, {}", lanes_.phong ? "phong" : "diffuse");
    add(text, lanes_.solids.size(), lanes_.enclosed ? "boxes in a box" : "boxes");
    add(text, lanes_.first_disk - lanes_.first_quad, "other parallelograms");
    add(text, lanes_.first_sphere - lanes_.first_disk, "disks");
    add(text, lanes_.first_sdf - lanes_.first_sphere, "spheres");
    add(text, lanes_.sdfs.size(), "sdfs");
    add(text, lanes_.surfaces - lanes_.first_mesh, "meshes");
    if (choices_.light_paths > 0) text += ", light paths";
    // A render is continued only with as many: others would be the same paths again.
    if (choices_.light_paths > 0 && choices_.light_paths < 1)
      text += fmt::format(" ({} a path)", choices_.light_paths);
    if (guide_) text += ", guided";
    return fmt::format("{}, {}", text, lane_instruction_set());
  }

  void render(const carlo::Tile& tile, std::span<std::array<double, 3>> means,
              carlo::Counts& counts) const override {
    render_blocks(tile, 1, means, counts);
  }

  void render_blocks(const carlo::Tile& tile, std::uint32_t blocks,
                     std::span<std::array<double, 3>> means, carlo::Counts& counts) const override {
    const LaneChoices choices = shared(tile.light_path_share);
    LaneJob of_tile = job(tile, choices);
    of_tile.blocks = blocks;
    render_lanes(of_tile, means, counts);
  }

  double seconds_spent() const override { return seconds_spent_; }

  double least_light_probability() const override {
    return lanes_.lights > 1 ? LightTree::floor / lanes_.lights : 1;
  }

  double light_paths() const override { return choices_.light_paths; }

  void trace_light_paths(const carlo::LightPaths& paths, carlo::Splats& splats,
                         carlo::Counts& counts) const override {
    const carlo::Tile any{.stream = paths.stream};
    const LaneChoices choices = shared(paths.share);
    const LaneJob whole = job(any, choices);
    renderer::trace_light_paths({whole, paths.first, paths.count, splats.unit()}, splats, counts);
  }

  double splat_unit(std::uint64_t paths) const override { return lanes_.splat_unit(paths); }

 private:
  LaneChoices shared(double light_path_share) const {
    LaneChoices choices = choices_;
    choices.light_paths *= static_cast<float>(light_path_share);
    return choices;
  }

  LaneJob job(const carlo::Tile& tile, const LaneChoices& choices) const {
    return {lanes_,
            scene_.camera,
            scene_.width,
            scene_.height,
            scene_.max_depth,
            carlo::stream_seed(seed_, tile.stream),
            lanes_.sobol,
            tile,
            choices,
            1,
            guide_ ? &*guide_ : nullptr};
  }

  /// Adds a count to the text; zero counts are left out.
  static void add(std::string& text, std::size_t count, const char* what) {
    if (count > 0) text += fmt::format(", {}: {}", what, count);
  }

  const carlo::Scene& scene_;
  LaneScene lanes_;
  std::uint64_t seed_;
  LaneChoices choices_;
  std::optional<Guide> guide_;
  double seconds_spent_ = 0;
};

}  // namespace

std::unique_ptr<carlo::Integrator> make_lane_integrator(const carlo::Scene& scene,
                                                        std::uint64_t seed,
                                                        const LaneChoices& choices,
                                                        const LaneTrials& trials) {
  if (lane_instruction_sets().empty()) {
    throw carlo::Error(
        "the vector kernel was compiled for another kind of processor than this machine's; configure "
        "with cmake --preset release -DCARLO_EVERY_INSTRUCTION_SET=ON and build again to support "
        "all kinds, or render with --kernel scalar");
  }
  return std::make_unique<LaneIntegrator>(scene, seed, choices, trials);
}

}  // namespace renderer
