// What a tile's paths bring. Included once for each instruction set.

#if defined(CARLO_SUMS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef CARLO_SUMS_INL
#undef CARLO_SUMS_INL
#else
#define CARLO_SUMS_INL
#endif

#include "renderer/lanes/paths-inl.h"
#include "renderer/lanes/vector_math-inl.h"

#include <hwy/highway.h>

#include <array>
#include <bit>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

HWY_BEFORE_NAMESPACE();
namespace renderer {
namespace HWY_NAMESPACE {

/// The radiances of a tile's pixels, summed in the order in which paths end.
class Sums {
 public:
  explicit Sums(const carlo::Tile& tile)
      : samples_(tile.samples),
        sums_(static_cast<std::size_t>((tile.x1 - tile.x0) * (tile.y1 - tile.y0))) {}

  /// What is no radiance is counted and left out, as in carlo::BlockSum.
  HWY_INLINE void add(const Paths& paths, M ended, carlo::Counts& counts) {
    const V3 L = paths.L;
    const M good = hn::And(hn::And(hn::Ge(L.x, set(0)), hn::Ge(L.y, set(0))),
                           hn::And(hn::Ge(L.z, set(0)),
                                   hn::Le(max_element(L), set(std::numeric_limits<float>::max()))));
    counts.bad += hn::CountTrue(d_, hn::AndNot(good, ended));
    alignas(64) std::array<float, lanes> r, g, b;
    alignas(64) std::array<std::uint32_t, lanes> pixel;
    hn::Store(L.x, d_, r.data());
    hn::Store(L.y, d_, g.data());
    hn::Store(L.z, d_, b.data());
    hn::Store(paths.pixel, du_, pixel.data());
    for (std::uint32_t left = bits(hn::And(good, ended)); left != 0; left &= left - 1) {
      const auto lane = static_cast<std::size_t>(std::countr_zero(left));
      std::array<double, 3>& sum = sums_[pixel[lane]];
      sum[0] += static_cast<double>(r[lane]);
      sum[1] += static_cast<double>(g[lane]);
      sum[2] += static_cast<double>(b[lane]);
    }
  }

  void means(std::span<std::array<double, 3>> result) const {
    for (std::size_t i = 0; i < sums_.size(); ++i) {
      for (std::size_t c = 0; c < 3; ++c)
        result[i][c] = sums_[i][c] / samples_;
    }
  }

 private:
  std::uint32_t samples_;
  std::vector<std::array<double, 3>> sums_;
};

}  // namespace HWY_NAMESPACE
}  // namespace renderer
HWY_AFTER_NAMESPACE();

#endif  // CARLO_SUMS_INL
