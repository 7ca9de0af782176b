#pragma once

#include "numeric/exact_sum.h"
#include "numeric/vec.h"
#include "random/hash.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace carlo {

/// A rectangle of pixels, [x0, x1) x [y0, y1), and the samples of each to take. The streams of a
/// pixel are sequences of samples that are independent of each other.
struct Tile {
  int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
  std::uint32_t first_sample = 0;
  std::uint32_t samples = 0;
  std::uint32_t stream = 0;
  /// The share of the light paths belonging to the samples (Integrator::light_paths) that is
  /// traced.
  double light_path_share = 1;
  /// Pixels may share what their paths find, so that the errors of some are alike. All sides must
  /// then be multiples of `sharing_pixels`, or the film's.
  bool share = false;
};
constexpr int sharing_pixels = 4;

/// A range of a stream's light paths.
struct LightPaths {
  std::uint64_t first = 0, count = 0;
  std::uint32_t stream = 0;
  double share = 1;  ///< Tile::light_path_share of the samples that they belong to
};

/// The seed of a stream of samples of an integrator with this seed; for stream 0 the seed itself.
constexpr std::uint64_t stream_seed(std::uint64_t seed, std::uint32_t stream) {
  return stream == 0 ? seed : hash(seed, stream);
}

struct Counts {
  std::uint64_t paths = 0;
  std::uint64_t rays = 0;         ///< of all kinds, including shadow rays; 0 if not counted
  std::uint64_t light_paths = 0;  ///< from lights, not included in `paths`
  std::uint64_t cut = 0;          ///< paths ended only because of their length
  std::uint64_t bad = 0;  ///< samples that were NaN, infinite or negative, and so count as black
  /// The covariances of the image's pixels caused by light paths that reach several pixels,
  /// summed over all these paths and divided by the squared share that was traced; in squared
  /// luminances of the image's mean.
  double splat_covariance = 0;
  /// The covariances of pixels that share paths (Tile::share), of each channel of a block's sums:
  /// for each block of the tile, summed over the tile's pixels, times the number of tiles.
  std::array<ExactSum, 3> shared_covariance{};

  Counts& operator+=(const Counts& other) {
    paths += other.paths;
    rays += other.rays;
    light_paths += other.light_paths;
    cut += other.cut;
    bad += other.bad;
    splat_covariance += other.splat_covariance;
    for (std::size_t c = 0; c < 3; ++c)
      shared_covariance[c].add(other.shared_covariance[c]);
    return *this;
  }
};

class Splats;

/// Sums samples in order, in double; counts and skips samples that are NaN, infinite or negative.
class BlockSum {
 public:
  void add(const Rgb& sample, Counts& counts) {
    if (!(std::isfinite(sample.x) && std::isfinite(sample.y) && std::isfinite(sample.z) &&
          sample.x >= 0 && sample.y >= 0 && sample.z >= 0)) {
      ++counts.bad;
      return;
    }
    sum_[0] += static_cast<double>(sample.x);
    sum_[1] += static_cast<double>(sample.y);
    sum_[2] += static_cast<double>(sample.z);
  }

  std::array<double, 3> mean(std::uint32_t samples) const {
    return {sum_[0] / samples, sum_[1] / samples, sum_[2] / samples};
  }

 private:
  std::array<double, 3> sum_{};
};

/// True if Ctrl-C asked the running render to end. A path that may be very long checks it now and
/// then; its result is then discarded.
bool render_interrupted();

/// Estimates the radiance of pixels. A sample's value depends on (seed, stream, pixel, sample
/// index) and Tile::share alone, so the driver may ask for tiles in any order and from any thread.
class Integrator {
 public:
  virtual ~Integrator() = default;

  /// The name of the chosen kernel, for the report.
  virtual std::string name() const = 0;

  /// The seconds spent on deciding how to render; they count as rendering time.
  virtual double seconds_spent() const { return 0; }

  /// The least probability with which a path samples a light that can contribute at its vertex
  /// (light_coverage.h); 1 if there is no choice.
  virtual double least_light_probability() const { return 1; }

  /// The number of light paths that an image needs, besides its tiles, per sample of each
  /// pixel, perhaps a fraction; 0 if all light is found from the camera.
  virtual double light_paths() const { return 0; }

  /// Traces light paths, by their numbers in the stream: each sample of an image of `pixels`
  /// has `light_paths() * pixels` of them; if only a share is traced, the first ones. A pixel's
  /// radiance is the sum of its splats over the number of traced paths. Adds to splat_covariance
  /// the products of every two splats of a path, in both orders, in squared luminances of splats.
  virtual void trace_light_paths(const LightPaths& /*paths*/, Splats& /*splats*/,
                                 Counts& /*counts*/) const {}
  /// The unit of splats for which the sums of `paths` paths cannot overflow.
  virtual double splat_unit(std::uint64_t /*paths*/) const { return 1; }

  /// Renders a tile: writes the mean of the samples of each of its pixels into `means`, row by row.
  virtual void render(const Tile& tile, std::span<std::array<double, 3>> means,
                      Counts& counts) const = 0;

  /// The same for this many blocks of samples, one after another from `tile` on: the means of all
  /// blocks of the first pixel, then those of the next. Integrators may do it faster at once, with
  /// the same means.
  virtual void render_blocks(const Tile& tile, std::uint32_t blocks,
                             std::span<std::array<double, 3>> means, Counts& counts) const {
    std::vector<std::array<double, 3>> of_block(means.size() / blocks);
    Tile block = tile;
    for (std::uint32_t b = 0; b < blocks; ++b, block.first_sample += tile.samples) {
      render(block, of_block, counts);
      for (std::size_t i = 0; i < of_block.size(); ++i)
        means[i * blocks + b] = of_block[i];
    }
  }
};

}  // namespace carlo
