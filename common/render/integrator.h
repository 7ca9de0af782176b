#pragma once

#include "numeric/vec.h"
#include "random/hash.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <string>

namespace carlo {

/// A rectangle of pixels, [x0, x1) x [y0, y1), and which samples of each to take. The streams of a
/// pixel are sequences of samples that are independent of each other.
struct Tile {
  int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
  std::uint32_t first_sample = 0;
  std::uint32_t samples = 0;
  std::uint32_t stream = 0;
  /// Of the paths from lamps that go with the samples (Integrator::lamp_paths) as many are traced.
  double lamp_share = 1;
};

/// Some of a stream's paths from lamps.
struct LampPaths {
  std::uint64_t first = 0, count = 0;
  std::uint32_t stream = 0;
  double share = 1;  ///< Tile::lamp_share of the samples that they go with
};

/// The seed of one of the streams of samples that an integrator with this seed has; of stream 0 it
/// is the seed itself.
constexpr std::uint64_t stream_seed(std::uint64_t seed, std::uint32_t stream) {
  return stream == 0 ? seed : hash(seed, stream);
}

struct Counts {
  std::uint64_t paths = 0;
  std::uint64_t rays = 0;  ///< of all kinds, shadow rays among them; 0 where nobody counts them
  std::uint64_t lamp_paths = 0;  ///< from lamps, beside those
  std::uint64_t cut = 0;         ///< paths that were ended for their length alone
  std::uint64_t bad = 0;  ///< samples that were NaN, infinite or negative; they count as black
  /// By how much paths from lamps that reach several pixels tie these together: over all such
  /// paths, the sum of the covariances of the image's pixels over the squared share that was
  /// traced, in squared luminances of the image's mean.
  double lamp_ties = 0;

  Counts& operator+=(const Counts& other) {
    paths += other.paths;
    rays += other.rays;
    lamp_paths += other.lamp_paths;
    cut += other.cut;
    bad += other.bad;
    lamp_ties += other.lamp_ties;
    return *this;
  }
};

class Splats;

/// Sums samples in order, in double; what is not a radiance is counted and left out.
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

/// Whether Ctrl-C asked the running render to end. A path that may be very long looks now and then;
/// what it returns then is thrown away.
bool render_interrupted();

/// Estimates the radiance of pixels. What a sample is worth depends on (seed, stream, pixel, sample
/// index) alone, so the driver may ask for tiles in any order and from any thread.
class Integrator {
 public:
  virtual ~Integrator() = default;

  /// What is printed as the kernel that was chosen.
  virtual std::string name() const = 0;

  /// The time that it took to decide how to render; it counts as the render's.
  virtual double seconds_spent() const { return 0; }

  /// The least chance with which a path asks a light that can reach its vertex (light_asks.h); 1
  /// where there is nothing to choose.
  virtual double least_light_chance() const { return 1; }

  /// What an image of `pixels` needs besides its tiles: the number of paths from lamps for each
  /// sample of a pixel; 0 if light is found from the camera alone.
  virtual std::uint32_t lamp_paths() const { return 0; }

  /// Such paths, by their numbers among the stream's: `lamp_paths() * pixels` for each sample, or
  /// the first of these. A
  /// splat is a radiance times how many of them there are. Of lamp_ties it counts the products of
  /// each two splats of a path, both ways round, in squared luminances of splats.
  virtual void trace_lamps(const LampPaths& /*paths*/, Splats& /*splats*/,
                           Counts& /*counts*/) const {}
  /// The unit of splats whose sums have room for `paths` of them.
  virtual double splat_unit(std::uint64_t /*paths*/) const { return 1; }

  /// Renders a tile: the mean of the samples of each of its pixels, row by row, into `means`.
  virtual void render(const Tile& tile, std::span<std::array<double, 3>> means,
                      Counts& counts) const = 0;
};

}  // namespace carlo
