// Guided sample points (guide.h), one in each lane. Included once for each instruction set.

#if defined(CARLO_GUIDE_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef CARLO_GUIDE_INL
#undef CARLO_GUIDE_INL
#else
#define CARLO_GUIDE_INL
#endif

#include "renderer/lanes/guide.h"
#include "renderer/lanes/lookup-inl.h"
#include "renderer/lanes/vector_math-inl.h"

#include <hwy/highway.h>

#include <cstddef>
#include <cstdint>

HWY_BEFORE_NAMESPACE();
namespace renderer {
namespace HWY_NAMESPACE {

/// Guide::sides, for unit normals on the side that a path came from.
HWY_INLINE U facing(V3 n) {
  const V x = hn::Abs(n.x), y = hn::Abs(n.y), z = hn::Abs(n.z);
  const M most_x = hn::Ge(x, hn::Max(y, z)), most_y = hn::Ge(y, z);
  const U axis =
      hn::IfThenZeroElse(hn::RebindMask(du_, most_x),
                         hn::IfThenElse(hn::RebindMask(du_, most_y), set_word(4), set_word(8)));
  const V largest = select(most_x, n.x, select(most_y, n.y, n.z));
  const U sign = hn::ShiftRight<31>(hn::BitCast(du_, largest));
  return hn::Add(axis, hn::Add(hn::Add(sign, sign), hn::ShiftRight<31>(hn::BitCast(du_, n.z))));
}

/// Guide::place().
HWY_INLINE U place_of(const Guide& guide, V3 p, U side) {
  const auto along = [&](V at, std::size_t axis) HWY_ATTR {
    const V cells = hn::Mul(hn::Sub(at, set(guide.lower[axis])), set(guide.cells_per_unit[axis]));
    const V inside = hn::Min(hn::Max(cells, set(0)), set(Guide::grid - 0.5f));
    return hn::BitCast(du_, hn::ConvertTo(di_, inside));
  };
  const U grid = set_word(Guide::grid);
  const U x = along(p.x, 0), y = along(p.y, 1), z = along(p.z, 2);
  const U cell = hn::Add(hn::Mul(hn::Add(hn::Mul(x, grid), y), grid), z);
  return hn::Add(hn::Mul(cell, set_word(Guide::sides)), side);
}

/// A point of the unit square, and one over the density with which it was drawn.
struct GuidedPoints {
  V2 u;
  V per_density;
};

/// Warps even points u by the guide's table for a place.
HWY_INLINE GuidedPoints guided_points(const Guide& guide, U place, V2 u) {
  const U table = gather_words(guide.table_of.data(), place);
  const V x = hn::Mul(u.x, set(Guide::rows)), y = hn::Mul(u.y, set(Guide::columns));
  const auto i = hn::ConvertTo(di_, x), j = hn::ConvertTo(di_, y);
  const auto rectangle = hn::Add(hn::Mul(i, hn::Set(di_, Guide::columns)), j);
  const U word = gather_words(guide.tables.data(), hn::Add(table, hn::BitCast(du_, rectangle)));
  const auto byte = [](U shifted) HWY_ATTR {
    return hn::ConvertTo(d_, hn::BitCast(di_, hn::And(shifted, set_word(0xFF))));
  };
  const V width = byte(hn::ShiftRight<16>(word)), height = byte(word);
  const auto within = [](V lower, V length, V fraction) HWY_ATTR {
    return hn::Min(hn::Mul(mul_add(fraction, length, lower), set(1.0f / 256)), set(0x1.fffffep-1f));
  };
  return {{within(byte(hn::ShiftRight<24>(word)), width, hn::Sub(x, hn::ConvertTo(d_, i))),
           within(byte(hn::ShiftRight<8>(word)), height, hn::Sub(y, hn::ConvertTo(d_, j)))},
          hn::Mul(hn::Mul(width, height), set(Guide::table_size / 65536.0f))};
}

}  // namespace HWY_NAMESPACE
}  // namespace renderer
HWY_AFTER_NAMESPACE();

#endif  // CARLO_GUIDE_INL
