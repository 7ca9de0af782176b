#pragma once

#include "numeric/vec.h"
#include "random/hash.h"
#include "random/philox.h"
#include "random/to_float.h"
#include "sampling/permutation.h"
#include "sampling/sobol.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

namespace carlo {

/// Identifies a sample of a pixel: with the seed, everything that its random numbers depend on.
struct SampleId {
  std::uint64_t seed = 0;
  std::uint32_t pixel = 0;  ///< row-major index in the film
  std::uint32_t index = 0;  ///< index of the sample within its pixel
  std::uint32_t spp = 1;    ///< planned number of samples per pixel
};

// A sampler returns the coordinates of one sample, a point of [0, 1)^infinity. Code that takes a
// varying number of coordinates calls seek() at fixed places, so that a dimension always means the
// same decision. Samplers are small values, created anew for every sample.

/// Independent uniform numbers.
class IndependentSampler {
 public:
  explicit IndependentSampler(const SampleId& id) : id_(id) {}

  void seek(std::uint32_t dimension) { dimension_ = dimension; }

  float next_1d() {
    const std::uint32_t block = dimension_ / 4;
    if (block != block_) {
      words_ = philox4x32(
          {block, id_.index, id_.pixel, 0},
          {static_cast<std::uint32_t>(id_.seed), static_cast<std::uint32_t>(id_.seed >> 32)});
      block_ = block;
    }
    return to_float(words_[dimension_++ % 4]);
  }

  Vec2 next_2d() {
    const float x = next_1d();  // two statements: the order of arguments is unspecified
    const float y = next_1d();
    return {x, y};
  }

 private:
  SampleId id_;
  std::uint32_t dimension_ = 0;
  std::uint32_t block_ = std::numeric_limits<std::uint32_t>::max();
  std::array<std::uint32_t, 4> words_{};
};

/// Jitters every coordinate, and every pair of next_2d(): the pixel's samples fall one each into
/// strata of equal measure, in an independent random order for each dimension.
class StratifiedSampler {
 public:
  explicit StratifiedSampler(const SampleId& id)
      : jitter_(id),
        index_(id.index % id.spp),
        spp_(id.spp),
        columns_(static_cast<std::uint32_t>(std::sqrt(static_cast<double>(id.spp)))),
        rows_((id.spp + columns_ - 1) / columns_),
        // A pixel that exceeds its planned samples starts a new set of strata.
        base_(hash(id.seed, id.pixel, id.index / id.spp)) {}

  void seek(std::uint32_t dimension) {
    dimension_ = dimension;
    jitter_.seek(dimension);
  }

  float next_1d() {
    const std::uint32_t stratum = permute(index_, spp_, order());
    dimension_ += 1;
    return place(stratum, spp_, jitter_.next_1d());
  }

  Vec2 next_2d() {
    const std::uint32_t cell = permute(index_, columns_ * rows_, order());
    dimension_ += 2;
    const Vec2 u = jitter_.next_2d();
    return {place(cell % columns_, columns_, u.x), place(cell / columns_, rows_, u.y)};
  }

 private:
  std::uint64_t order() const { return hash(base_, dimension_); }

  /// Returns (stratum + u) / n, in double and kept below 1: in float the last stratum would round
  /// up to 1.
  static float place(std::uint32_t stratum, std::uint32_t n, float u) {
    const double x = (static_cast<double>(stratum) + static_cast<double>(u)) / n;
    return std::fmin(static_cast<float>(x), 0x1.fffffep-1f);
  }

  IndependentSampler jitter_;
  std::uint32_t index_, spp_, columns_, rows_;
  std::uint64_t base_;
  std::uint32_t dimension_ = 0;
};

/// Owen-scrambled Sobol' points, padded: each coordinate or pair is an independently shuffled and
/// scrambled sequence, so that every power-of-two run of samples is stratified in every pair.
class SobolSampler {
 public:
  explicit SobolSampler(const SampleId& id) : index_(id.index), base_(hash(id.seed, id.pixel)) {}

  void seek(std::uint32_t dimension) { dimension_ = dimension; }

  float next_1d() {
    const std::uint64_t h = mix(base_ ^ dimension_);
    dimension_ += 1;
    const std::uint32_t x = nested_hash(reverse_bits(index_), static_cast<std::uint32_t>(h));
    return to_float(owen_scramble(x, static_cast<std::uint32_t>(h >> 32)));
  }

  Vec2 next_2d() {
    const std::uint64_t h = mix(base_ ^ dimension_);
    const std::uint64_t k = mix(h);
    dimension_ += 2;
    return shuffled_sobol_2d(index_, static_cast<std::uint32_t>(h), static_cast<std::uint32_t>(k),
                             static_cast<std::uint32_t>(k >> 32));
  }

 private:
  std::uint32_t index_;
  std::uint64_t base_;
  std::uint32_t dimension_ = 0;
};

}  // namespace carlo
