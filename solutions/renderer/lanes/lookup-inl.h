// Lookups by number in short columns, one number per lane. Included once for each instruction set.

#if defined(CARLO_LOOKUP_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef CARLO_LOOKUP_INL
#undef CARLO_LOOKUP_INL
#else
#define CARLO_LOOKUP_INL
#endif

#include "renderer/lanes/vector_math-inl.h"

#include <hwy/highway.h>

#include <array>
#include <cstdint>

HWY_BEFORE_NAMESPACE();
namespace renderer {
namespace HWY_NAMESPACE {

/// Entries of a column that is too long for Numbers, or read only once.
HWY_INLINE V gather(const float* column, U index) {
  return hn::GatherIndex(d_, column, hn::BitCast(di_, index));
}
HWY_INLINE U gather_words(const std::uint32_t* column, U index) {
  return hn::BitCast(du_, gather(reinterpret_cast<const float*>(column), index));
}

/// Numbers below `size`, prepared for lookups. Permuting a register costs a fraction of a gather,
/// so columns of a few registers are read whole. Columns must be as long as the registers that
/// cover `size`.
class Numbers {
 public:
  HWY_INLINE Numbers(U numbers, std::uint32_t size)
      : numbers_(numbers),
        within_(hn::IndicesFromVec(d_, hn::And(numbers, set_word(lanes - 1)))),
        registers_((size + lanes - 1) / lanes) {
    for (std::size_t r = 1; r < most && r < registers_; ++r) {
      beyond_[r] =
          hn::RebindMask(d_, hn::Gt(numbers, set_word(static_cast<std::uint32_t>(r * lanes - 1))));
    }
  }

  HWY_INLINE V operator()(const float* column) const { return at(std::array{column})[0]; }
  HWY_INLINE U operator()(const std::uint32_t* column) const {
    return hn::BitCast(du_, (*this)(reinterpret_cast<const float*>(column)));
  }
  template <class Column>
  HWY_INLINE V3 operator()(const Column& x, const Column& y, const Column& z) const {
    const auto found = at(std::array<const float*, 3>{x.data(), y.data(), z.data()});
    return {found[0], found[1], found[2]};
  }

 private:
  /// Reads several columns at once, so that their number of registers is tested only once.
  template <std::size_t n>
  HWY_INLINE std::array<V, n> at(const std::array<const float*, n>& columns) const {
    std::array<V, n> found;
    for (std::size_t c = 0; c < n; ++c) {
      found[c] = registers_ > most ? gather(columns[c], numbers_)
                                   : hn::TableLookupLanes(hn::LoadU(d_, columns[c]), within_);
    }
    if (registers_ > most) return found;
    for (std::size_t r = 1; r < registers_; ++r) {
      for (std::size_t c = 0; c < n; ++c) {
        const V here = hn::TableLookupLanes(hn::LoadU(d_, columns[c] + r * lanes), within_);
        found[c] = select(beyond_[r], here, found[c]);
      }
    }
    return found;
  }

  static constexpr std::size_t most = 4;
  U numbers_;
  decltype(hn::IndicesFromVec(d_, hn::Zero(du_))) within_;
  std::size_t registers_;
  std::array<M, most> beyond_;
};

}  // namespace HWY_NAMESPACE
}  // namespace renderer
HWY_AFTER_NAMESPACE();

#endif  // CARLO_LOOKUP_INL
