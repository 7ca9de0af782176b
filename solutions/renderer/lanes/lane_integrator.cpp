#include "renderer/lanes/lane_integrator.h"

#include "image/image.h"
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
constexpr double least_gain = 3, least_gain_with_lobes = 1, least_gain_with_mirrors = 0.8;

struct Trial {
  Means mean, variance;  ///< over the pixels of a block
  double rays = 0;
};

class Pilot {
 public:
  Pilot(const carlo::Scene& scene, const LaneScene& lanes, std::uint64_t seed, int side)
      : scene_(scene), lanes_(lanes), seed_(seed), side_(side) {}

  Trial run(bool light_paths) const {
    const LaneChoices choices{.light_paths = light_paths ? 1.0f : 0.0f};
    carlo::Counts counts;
    Trial trial{Means(pixels()), Means(pixels()), 0};
    for (std::uint32_t b = 0; b < blocks; ++b) {
      const Means block = render(b, choices, counts);
      for (std::size_t i = 0; i < pixels(); ++i) {
        for (std::size_t c = 0; c < 3; ++c) {
          trial.mean[i][c] += block[i][c] / blocks;
          trial.variance[i][c] += block[i][c] * block[i][c] / blocks;
        }
      }
    }
    for (std::size_t i = 0; i < pixels(); ++i) {
      for (std::size_t c = 0; c < 3; ++c)
        trial.variance[i][c] -= trial.mean[i][c] * trial.mean[i][c];
    }
    trial.rays = static_cast<double>(counts.rays);
    return trial;
  }

 private:
  std::size_t pixels() const {
    return static_cast<std::size_t>(side_) * static_cast<std::size_t>(side_);
  }

  Means render(std::uint32_t block, const LaneChoices& choices, carlo::Counts& counts) const {
    const carlo::Tile tile{0, 0, side_, side_, block * samples, samples, 0};
    const LaneJob job{lanes_, scene_.camera, side_, side_,  scene_.max_depth,
                      seed_,  lanes_.sobol,  tile,  choices};
    Means means(pixels());
    render_lanes(job, means, counts);
    if (choices.light_paths == 0) return means;
    const std::uint64_t count = std::uint64_t{samples} * pixels();
    carlo::Splats splats(pixels(), lanes_.splat_unit(count));
    trace_light_paths({job, block * count, count, splats.unit()}, splats, counts);
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

/// True if a render of this scene should trace a light path for each path from the camera.
/// Both techniques are tried on an image of few pixels and compared by the relative variance of a
/// pixel times the number of rays. Always true where points shine on mirrors or glass: other paths
/// miss that light. The same seed and spp give the same answer. Traces about 0.6 % as many paths as
/// the render, and at least 25000.
bool try_light_paths(const carlo::Scene& scene, const LaneScene& lanes, std::uint64_t seed,
                     std::uint32_t spp) {
  if (!lanes.has_path_starts()) return false;
  // No other path finds what points send by mirrors and glass.
  if (lanes.point_lights() && lanes.any_specular) return true;
  const double paths = static_cast<double>(scene.width) * scene.height * spp / share;
  const double side = std::sqrt(paths / (blocks * samples));
  const Pilot pilot(scene, lanes, seed, static_cast<int>(std::clamp(side, 8.0, 64.0)));
  const Trial without = pilot.run(false), with = pilot.run(true);
  const double cost = lanes.full() ? 1 : ray_cost;
  // The better image serves both, so that light that one of them missed does not look dark.
  const double before = relative_variance(without, with.mean) * without.rays;
  const double after = relative_variance(with, with.mean) * with.rays * cost;
  const double gain = lanes.any_specular ? least_gain_with_mirrors
                      : lanes.phong      ? least_gain_with_lobes
                                         : least_gain;
  return after * gain < before;
}

class LaneIntegrator final : public carlo::Integrator {
 public:
  LaneIntegrator(const carlo::Scene& scene, std::uint64_t seed, const LaneChoices& choices,
                 std::optional<std::uint32_t> pilot_spp)
      : scene_(scene), lanes_(scene), seed_(seed), choices_(choices) {
    if (!pilot_spp || scene.max_depth == 1) return;  // light paths have two segments or more
    const auto start = std::chrono::steady_clock::now();
    choices_.light_paths = try_light_paths(scene, lanes_, seed, *pilot_spp) ? 1.0f : 0.0f;
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

  std::uint32_t light_paths() const override {
    return static_cast<std::uint32_t>(choices_.light_paths);
  }

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
    return {lanes_,           scene_.camera,
            scene_.width,     scene_.height,
            scene_.max_depth, carlo::stream_seed(seed_, tile.stream),
            lanes_.sobol,     tile,
            choices};
  }

  /// Adds a count to the text; zero counts are left out.
  static void add(std::string& text, std::size_t count, const char* what) {
    if (count > 0) text += fmt::format(", {}: {}", what, count);
  }

  const carlo::Scene& scene_;
  LaneScene lanes_;
  std::uint64_t seed_;
  LaneChoices choices_;
  double seconds_spent_ = 0;
};

}  // namespace

std::unique_ptr<carlo::Integrator> make_lane_integrator(const carlo::Scene& scene,
                                                        std::uint64_t seed,
                                                        const LaneChoices& choices,
                                                        std::optional<std::uint32_t> pilot_spp) {
  if (lane_instruction_sets().empty()) {
    throw carlo::Error(
        "the vector kernel was compiled for another kind of processor than this machine's; configure "
        "with cmake --preset release -DCARLO_EVERY_INSTRUCTION_SET=ON and build again to support "
        "all kinds, or render with --kernel scalar");
  }
  return std::make_unique<LaneIntegrator>(scene, seed, choices, pilot_spp);
}

}  // namespace renderer
