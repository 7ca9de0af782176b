// Sums up the radiances of a tile's paths. Included once for each instruction set.

#if defined(CARLO_SUMS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef CARLO_SUMS_INL
#undef CARLO_SUMS_INL
#else
#define CARLO_SUMS_INL
#endif

#include "renderer/lanes/paths-inl.h"
#include "renderer/lanes/vector_math-inl.h"

#include <hwy/highway.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>

HWY_BEFORE_NAMESPACE();
namespace renderer {
namespace HWY_NAMESPACE {

/// The radiances of paths, by Paths::number, since the order in which paths end depends on the
/// number of lanes.
class Radiances {
 public:
  explicit Radiances(std::size_t paths)
      : kept_(std::make_unique_for_overwrite<float[]>(3 * (paths + lanes))) {}

  /// Stores those of paths that have ended. Invalid values are counted and become black, as in
  /// carlo::BlockSum.
  HWY_INLINE void keep(const Paths& paths, M ended, carlo::Counts& counts) {
    const V3 L = valid(paths.L, ended, counts);
    const ToFront front(ended);
    hn::StoreU(front(L.x), d_, r_.data() + queued_);
    hn::StoreU(front(L.y), d_, g_.data() + queued_);
    hn::StoreU(front(L.z), d_, b_.data() + queued_);
    hn::StoreU(front(paths.number), du_, number_.data() + queued_);
    queued_ += hn::CountTrue(d_, ended);
    if (queued_ > queue_length) put_in_place();
  }

  /// The same for a register of paths that are numbered from `first` on: the lanes of `ended`.
  HWY_INLINE void keep_row(const Paths& paths, M ended, std::uint32_t first,
                           carlo::Counts& counts) {
    const V3 L = valid(paths.L, ended, counts);
    hn::StoreInterleaved3(L.x, L.y, L.z, d_, kept_.get() + std::size_t{3} * first);
  }

  /// All that were stored, rgb rgb ...
  const float* stored() {
    put_in_place();
    return kept_.get();
  }

  HWY_INLINE static V3 valid(V3 L, M ended, carlo::Counts& counts) {
    const M good = hn::And(hn::And(hn::Ge(L.x, set(0)), hn::Ge(L.y, set(0))),
                           hn::And(hn::Ge(L.z, set(0)),
                                   hn::Le(max_element(L), set(std::numeric_limits<float>::max()))));
    counts.bad += hn::CountTrue(d_, hn::AndNot(good, ended));
    return {hn::IfThenElseZero(good, L.x), hn::IfThenElseZero(good, L.y),
            hn::IfThenElseZero(good, L.z)};
  }

 private:
  void put_in_place() {
    for (std::size_t i = 0; i < queued_; ++i) {
      float* const kept = kept_.get() + std::size_t{3} * number_[i];
      kept[0] = r_[i], kept[1] = g_[i], kept[2] = b_[i];
    }
    queued_ = 0;
  }

  /// Paths that have ended are collected here, since branch prediction cannot foresee how many end
  /// at a time.
  static constexpr std::size_t queue_length = 128;
  std::array<float, queue_length + 2 * lanes> r_, g_, b_;
  std::array<std::uint32_t, queue_length + 2 * lanes> number_;
  std::size_t queued_ = 0;
  std::unique_ptr<float[]> kept_;  ///< with room for a register behind the last
};

/// The radiances of the blocks of a tile's pixels, summed in the order of the samples. Up to `most`
/// samples are stored before they are added.
class Sums {
 public:
  static constexpr std::uint32_t most = 1 << 14;

  /// The means go to `means` as render_lanes() returns them.
  Sums(const LaneJob& job, std::span<std::array<double, 3>> means)
      : radiances_(std::min<std::size_t>(most, means.size() * job.tile.samples)),
        samples_(job.tile.samples),
        blocks_(job.blocks),
        means_(means) {}

  Radiances& radiances() { return radiances_; }

  /// The first `count` stored samples, rgb rgb ...
  std::span<const float> stored(std::uint32_t count) {
    return {radiances_.stored(), std::size_t{3} * count};
  }

  /// Adds the first `count` stored samples to the sums; completes the blocks that they end.
  void add(std::uint32_t count) {
    const float* next = radiances_.stored();
    while (count > 0) {
      const std::uint32_t here = std::min(count, samples_ - sample_);
      Four four = sample_ == 0 ? Four{} : four_;
      next = add_to_block(here, next, four);
      count -= here;
      if (sample_ < samples_) {
        four_ = four;
        return;
      }
      complete(four);
    }
  }

  /// Adds samples that are `radiance` where `hit` has a bit, and 0 elsewhere; exact, as such sums
  /// of floats are in double. They come alone in their blocks.
  void add_hits(std::uint32_t hit, std::uint32_t count, carlo::Vec3 radiance) {
    while (count > 0) {
      const std::uint32_t here = std::min(count, samples_ - sample_);
      hits_ += static_cast<std::uint32_t>(std::popcount(hit & (~std::uint32_t{0} >> (32 - here))));
      hit = here < 32 ? hit >> here : 0;
      count -= here;
      sample_ += here;
      if (sample_ < samples_) return;
      std::array<double, 3>& mean = means_[block_];
      for (std::size_t c = 0; c < 3; ++c)
        mean[c] = static_cast<double>(hits_) * static_cast<double>(radiance[c]) / samples_;
      hits_ = sample_ = 0;
      ++block_;
    }
  }

  /// Adds all samples of the next pixels, each of them this radiance: exact.
  void add_pixels(int count, carlo::Vec3 radiance) {
    for (const std::size_t end = block_ + std::size_t{blocks_} * static_cast<unsigned>(count);
         block_ < end; ++block_)
      means_[block_] = {radiance.x, radiance.y, radiance.z};
  }

 private:
  /// Four interleaved sums hide the latency of additions.
  using Four = std::array<double, 12>;

  /// Adds this many samples to the block; returns the next sample.
  HWY_INLINE const float* add_to_block(std::uint32_t count, const float* next, Four& four) {
    const std::uint32_t end = sample_ + count;
    const auto one = [&] {
      for (std::size_t c = 0; c < 3; ++c)
        four[sample_ % 4 * 3 + c] += static_cast<double>(*next++);
      ++sample_;
    };
    while (sample_ < end && sample_ % 4 != 0)
      one();
    for (; sample_ + 4 <= end; sample_ += 4, next += four.size()) {
      for (std::size_t i = 0; i < four.size(); ++i)
        four[i] += static_cast<double>(next[i]);
    }
    while (sample_ < end)
      one();
    return next;
  }

  HWY_INLINE void complete(const Four& four) {
    std::array<double, 3>& mean = means_[block_];
    for (std::size_t c = 0; c < 3; ++c)
      mean[c] = ((four[c] + four[3 + c]) + (four[6 + c] + four[9 + c])) / samples_;
    sample_ = 0;
    ++block_;
  }

  Radiances radiances_;
  std::uint32_t samples_, blocks_;
  std::span<std::array<double, 3>> means_;
  /// What has been added: blocks, and samples of the next one, with their sums or hits.
  std::size_t block_ = 0;
  std::uint32_t sample_ = 0, hits_ = 0;
  Four four_{};
};

}  // namespace HWY_NAMESPACE
}  // namespace renderer
HWY_AFTER_NAMESPACE();

#endif  // CARLO_SUMS_INL
