#pragma once

#include "image/image.h"
#include "numeric/exact_sum.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace carlo {

/// The accumulated samples of one pixel. The sums are exact: they do not depend on the order of
/// additions.
struct PixelSums {
  std::array<ExactSum, 3> sum;      ///< of block means
  std::array<ExactSum, 3> squares;  ///< of squared block means
  std::uint32_t blocks = 0;
  std::uint64_t samples = 0;
};

/// Accumulates the samples of an image, with an estimate of the error.
///
/// The samples of a pixel come in blocks of equal size (a power of two); the spread of the block
/// means gives the standard error. For independent samples that estimate is unbiased. Blocks of
/// stratified and of scrambled Sobol' points are negatively correlated, which makes it an upper
/// bound, except for few Sobol' points (below 32: tests/renderer/error_bars_test.cpp). Films of the
/// same size and block may be merged in any order. Radiances may be any finite floats: values far
/// below a pixel's largest sample are lost in its sums, as exact_sum.h says.
class Film {
 public:
  /// Throws Error if the film is empty or over 2^25 pixels.
  Film(int width, int height, std::uint32_t block);

  int width() const { return width_; }
  int height() const { return height_; }
  std::uint32_t block() const { return block_; }

  /// Adds one block, given as the mean of block() samples of a pixel; finite. Two threads may add
  /// to different pixels at once.
  void add_block(int x, int y, const std::array<double, 3>& mean);
  void add_blocks(int x, int y, std::span<const std::array<double, 3>> means);

  /// Stores an estimate made elsewhere, for a pixel without blocks: two blocks, one standard error
  /// to either side of the mean, have that mean and that standard error. Both finite.
  void set_estimate(int x, int y, const std::array<double, 3>& mean,
                    const std::array<double, 3>& standard_error, std::uint64_t samples);

  /// The exact state of a pixel; another film of the same size and block may continue from it.
  const PixelSums& sums(int x, int y) const { return pixels_[index(x, y)]; }
  void set_sums(int x, int y, const PixelSums& sums) { pixels_[index(x, y)] = sums; }

  /// Adds another film of the same size and block.
  void merge(const Film& other);

  std::uint32_t blocks(int x, int y) const { return pixels_[index(x, y)].blocks; }
  /// The estimate of one pixel's channel; 0 before its first block.
  double mean(int x, int y, std::size_t channel) const;
  /// The estimated variance of mean(); infinite with fewer than two blocks.
  double variance(int x, int y, std::size_t channel) const;

  /// The estimate of each pixel; 0 where there is no sample yet.
  Image mean() const;
  /// The estimated standard error of each pixel's mean.
  Image standard_error() const;

  std::uint64_t samples() const;
  std::uint64_t samples(int x, int y) const { return pixels_[index(x, y)].samples; }

 private:
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
           static_cast<std::size_t>(x);
  }
  /// The image of value(x, y, channel).
  template <class Value>
  Image image_of(const Value& value) const;

  int width_, height_;
  std::uint32_t block_;
  std::vector<PixelSums> pixels_;
};

/// The mean over all pixels that have samples, and its standard error, per channel.
struct MeanRadiance {
  std::array<double, 3> value{};
  std::array<double, 3> standard_error{};
};
MeanRadiance mean_radiance(const Film& film);

}  // namespace carlo
