#pragma once

#include "image/image.h"

#include <array>
#include <limits>
#include <span>

namespace carlo {

/// The mean of numbers in groups, each of a few blocks of equal size; the variance of the mean
/// follows from the spread of the blocks within each group. Groups may differ in size, so that
/// blocks can grow with the number of samples. Scrambled Sobol' points need that: their error falls
/// faster than one over the square root of the block's size.
class GroupedMean {
 public:
  /// The whole state: the sum of the samples, the sum of the groups' squared deviations, and the
  /// number of samples.
  struct Sums {
    double sum = 0, squares = 0, samples = 0;
  };

  GroupedMean() = default;
  explicit GroupedMean(const Sums& sums)
      : sum_(sums.sum), variance_(sums.squares), n_(sums.samples) {}
  Sums sums() const { return {sum_, variance_, n_}; }

  /// Adds a group of at least two block means of `samples` samples each. A group must be
  /// independent of the earlier ones, or negatively correlated, which makes variance() an upper
  /// bound.
  void add(std::span<const double> blocks, double samples) {
    const auto count = static_cast<double>(blocks.size());
    double mean = 0, squares = 0;
    for (const double x : blocks)
      mean += x;
    mean /= count;
    for (const double x : blocks)
      squares += (x - mean) * (x - mean);
    const double n = count * samples;
    sum_ += n * mean;
    variance_ += n * n * squares / (count * (count - 1));
    n_ += n;
  }

  double samples() const { return n_; }
  /// 0 before the first group.
  double mean() const { return n_ > 0 ? sum_ / n_ : 0; }
  /// The estimated variance of mean(); infinite before the first group.
  double variance() const {
    return n_ > 0 ? variance_ / (n_ * n_) : std::numeric_limits<double>::infinity();
  }

 private:
  double sum_ = 0, variance_ = 0, n_ = 0;
};

/// One half of an adaptively sampled pixel. Its samples decide when the other half is finished,
/// never when it is finished itself, so stopping biases neither the estimate nor its standard error
/// (adaptive.h).
class HalfPixel {
 public:
  static constexpr std::size_t blocks = 8;  ///< per group

  HalfPixel() = default;
  /// Restores a half with this state, to continue from it.
  HalfPixel(const std::array<GroupedMean, 4>& estimate, const GroupedMean& seen, bool finished)
      : estimate_(estimate), seen_(seen), finished_(finished) {}

  using Group = std::array<std::array<double, 3>, blocks>;

  /// Adds a group of block means of `samples` samples each.
  void add(const Group& group, double samples) {
    std::array<double, blocks> values;
    for (std::size_t b = 0; b < blocks; ++b)
      values[b] = luminance(group[b]);
    seen_.add(values, samples);
    if (finished_) return;
    estimate_[3].add(values, samples);
    for (std::size_t c = 0; c < 3; ++c) {
      for (std::size_t b = 0; b < blocks; ++b)
        values[b] = group[b][c];
      estimate_[c].add(values, samples);
    }
  }

  /// From now on samples are added to seen() only.
  void finish() { finished_ = true; }
  bool finished() const { return finished_; }

  /// The estimate of channel R, G, B, or the luminance (3).
  const GroupedMean& estimate(std::size_t channel) const { return estimate_[channel]; }
  /// The luminance of all samples, including those after finish().
  const GroupedMean& seen() const { return seen_; }

 private:
  std::array<GroupedMean, 4> estimate_;
  GroupedMean seen_;
  bool finished_ = false;
};

}  // namespace carlo
