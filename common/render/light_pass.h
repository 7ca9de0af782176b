#pragma once

#include "render/integrator.h"
#include "render/splats.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

namespace carlo {

/// The contribution of light paths to all pixels of an image, in addition to some samples of
/// each: the part that Integrator::render() leaves to them. Nothing if there are no such paths.
class LightPass {
 public:
  /// Traces the paths belonging to these samples of a stream, or about the share `share` of them,
  /// above 0 and at most 1, in the caller's task arena.
  LightPass(const Integrator& integrator, std::size_t pixels, std::uint32_t stream,
            std::uint32_t first_sample, std::uint32_t samples, double share = 1);

  /// The share that was traced, a little more than asked for where that is no whole number of
  /// paths: Tile::light_path_share of the samples' tiles.
  double share() const { return share_; }

  const Counts& counts() const { return counts_; }

  /// Adds the contribution to the mean of a pixel's samples.
  void add_to(std::array<double, 3>& mean, std::size_t pixel) const {
    if (!splats_) return;
    for (std::size_t c = 0; c < 3; ++c)
      mean[c] += splats_->sum(pixel, c) / paths_;
  }

 private:
  /// The sum of the products of the mean luminances over ordered pairs of different pixels.
  double products_of_means(std::size_t pixels) const;

  std::optional<Splats> splats_;
  double paths_ = 0, share_ = 1;
  Counts counts_;
};

}  // namespace carlo
