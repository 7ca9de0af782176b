#include "renderer/lanes/lane_pilot.h"

#include "image/luminance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
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

}  // namespace

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

}  // namespace renderer
