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
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <vector>

HWY_BEFORE_NAMESPACE();
namespace renderer {
namespace HWY_NAMESPACE {

/// The radiances of a tile's pixels, summed in the order of the samples, since the order in which
/// paths end depends on the number of lanes. Up to `most` samples are stored before they are added.
class Sums {
 public:
  static constexpr std::uint32_t most = 1 << 14;

  explicit Sums(const carlo::Tile& tile)
      : samples_(tile.samples),
        sums_(static_cast<std::size_t>((tile.x1 - tile.x0) * (tile.y1 - tile.y0))),
        kept_(std::make_unique_for_overwrite<float[]>(
            3 * std::min<std::size_t>(most, sums_.size() * samples_))) {}

  /// Stores the radiances of paths that have ended, by Paths::number. Invalid values are counted
  /// and skipped, as in carlo::BlockSum.
  HWY_INLINE void keep(const Paths& paths, M ended, carlo::Counts& counts) {
    const V3 L = paths.L;
    const M good = hn::And(hn::And(hn::Ge(L.x, set(0)), hn::Ge(L.y, set(0))),
                           hn::And(hn::Ge(L.z, set(0)),
                                   hn::Le(max_element(L), set(std::numeric_limits<float>::max()))));
    counts.bad += hn::CountTrue(d_, hn::AndNot(good, ended));
    const ToFront front(ended);
    hn::StoreU(front(hn::IfThenElseZero(good, L.x)), d_, r_.data() + queued_);
    hn::StoreU(front(hn::IfThenElseZero(good, L.y)), d_, g_.data() + queued_);
    hn::StoreU(front(hn::IfThenElseZero(good, L.z)), d_, b_.data() + queued_);
    hn::StoreU(front(paths.number), du_, number_.data() + queued_);
    queued_ += hn::CountTrue(d_, ended);
    if (queued_ > queue_length) put_in_place();
  }

  /// Adds the first `count` stored samples to the sums.
  void add(std::uint32_t count) {
    put_in_place();
    const float* next = kept_.get();
    while (count > 0) {
      const std::uint32_t here = std::min(count, samples_ - sample_);
      next = add_to_pixel(here, next);
      count -= here;
      if (sample_ < samples_) return;
      for (std::size_t c = 0; c < 3; ++c)
        sums_[pixel_][c] = (four_[c] + four_[3 + c]) + (four_[6 + c] + four_[9 + c]);
      ++pixel_, sample_ = 0, four_.fill(0);
    }
  }

  void means(std::span<std::array<double, 3>> result) const {
    for (std::size_t i = 0; i < sums_.size(); ++i) {
      for (std::size_t c = 0; c < 3; ++c)
        result[i][c] = sums_[i][c] / samples_;
    }
  }

 private:
  void put_in_place() {
    for (std::size_t i = 0; i < queued_; ++i) {
      float* const kept = kept_.get() + std::size_t{3} * number_[i];
      kept[0] = r_[i], kept[1] = g_[i], kept[2] = b_[i];
    }
    queued_ = 0;
  }

  /// Adds this many samples to a pixel; returns the next sample. Four interleaved sums hide the
  /// latency of additions.
  const float* add_to_pixel(std::uint32_t count, const float* next) {
    const std::uint32_t end = sample_ + count;
    const auto one = [&] {
      for (std::size_t c = 0; c < 3; ++c)
        four_[sample_ % 4 * 3 + c] += static_cast<double>(*next++);
      ++sample_;
    };
    while (sample_ < end && sample_ % 4 != 0)
      one();
    std::array<double, 12> four = four_;
    for (; sample_ + 4 <= end; sample_ += 4, next += four.size()) {
      for (std::size_t i = 0; i < four.size(); ++i)
        four[i] += static_cast<double>(next[i]);
    }
    four_ = four;
    while (sample_ < end)
      one();
    return next;
  }

  /// Paths that have ended are collected here, since branch prediction cannot foresee how many end
  /// at a time.
  static constexpr std::size_t queue_length = 128;
  std::array<float, queue_length + 2 * lanes> r_, g_, b_;
  std::array<std::uint32_t, queue_length + 2 * lanes> number_;
  std::size_t queued_ = 0;

  std::uint32_t samples_;
  std::vector<std::array<double, 3>> sums_;
  std::unique_ptr<float[]> kept_;
  std::size_t pixel_ = 0;          ///< the pixel that add() has reached,
  std::uint32_t sample_ = 0;       ///< the number of its samples so far,
  std::array<double, 12> four_{};  ///< and the four interleaved sums of them
};

}  // namespace HWY_NAMESPACE
}  // namespace renderer
HWY_AFTER_NAMESPACE();

#endif  // CARLO_SUMS_INL
