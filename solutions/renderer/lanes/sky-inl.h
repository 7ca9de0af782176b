// The environment map, one direction per lane. Included once for each instruction set.

#if defined(CARLO_SKY_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef CARLO_SKY_INL
#undef CARLO_SKY_INL
#else
#define CARLO_SKY_INL
#endif

#include "renderer/envmap_table.h"
#include "renderer/lanes/elementary-inl.h"
#include "renderer/lanes/lookup-inl.h"
#include "renderer/lanes/vector_math-inl.h"

#include <hwy/highway.h>

#include <bit>
#include <cstddef>
#include <cstdint>

HWY_BEFORE_NAMESPACE();
namespace renderer {
namespace HWY_NAMESPACE {

/// The angle of (x, y) from the x axis, in whole turns from -1/2 to 1/2.
HWY_INLINE V turns_to(V y, V x) {
  const V ax = hn::Abs(x), ay = hn::Abs(y);
  const V larger = hn::Max(hn::Max(ax, ay), set(1e-30f)), smaller = hn::Min(ax, ay);
  V turns = turns_of_tangent(hn::Div(smaller, larger));
  turns = select(hn::Gt(ay, ax), hn::Sub(set(0.25f), turns), turns);
  turns = select(hn::Lt(x, set(0)), hn::Sub(set(0.5f), turns), turns);
  return hn::CopySign(turns, y);
}

/// The index of that of `count` equal steps of [0, 1] which contains x.
HWY_INLINE U step_in(V x, std::size_t count) {
  const U step = hn::BitCast(du_, hn::ConvertTo(di_, hn::Mul(x, set(static_cast<float>(count)))));
  return hn::Min(step, set_word(static_cast<std::uint32_t>(count - 1)));
}

/// A texel's radiance, and the density per solid angle with which its directions are drawn.
struct Texels {
  V3 radiance;
  V pdf;
};
HWY_INLINE Texels texels(const EnvmapTable& table, U index) {
  const float* first = table.texels.data()->data();
  const U at = hn::ShiftLeft<2>(index);
  return {{gather(first, at), gather(first + 1, at), gather(first + 2, at)}, gather(first + 3, at)};
}

/// EnvmapTable::at() for the lanes of `active`.
inline HWY_NOINLINE Texels sky_at(const EnvmapTable& table, const V3& d, M active) {
  const glm::mat3& m = table.rotation;
  const V3 there = select(active, d, set(m[1][0], m[1][1], m[1][2]));  // up, in lanes that are not
                                                                       // active
  const V x = dot(there, set(m[0][0], m[0][1], m[0][2])),
          y = dot(there, set(m[1][0], m[1][1], m[1][2])),
          z = dot(there, set(m[2][0], m[2][1], m[2][2]));
  const V around = turns_to(x, hn::Neg(z));
  const V s = select(hn::Lt(around, set(0)), hn::Add(around, set(1)), around);
  const V t = hn::Mul(set(2), turns_to(hn::Sqrt(mul_add(x, x, hn::Mul(z, z))), y));
  const U row = step_in(t, table.height), column = step_in(s, table.width);
  return texels(table,
                hn::Add(hn::Mul(row, set_word(static_cast<std::uint32_t>(table.width))), column));
}

/// The index of that of `count` steps of running sums (from `first` on in each lane) which contains
/// u, and the position of u within it.
struct SumSteps {
  U index;
  V within;
};
HWY_INLINE SumSteps step_of(const float* sums, U first, std::size_t count, V u) {
  U index = set_word(0);
  for (auto half = static_cast<std::uint32_t>(std::bit_floor(count)); half > 0; half /= 2) {
    const U next =
        hn::Min(hn::Add(index, set_word(half)), set_word(static_cast<std::uint32_t>(count)));
    const M above = hn::Le(gather(sums, hn::Add(first, next)), u);
    index = hn::IfThenElse(hn::RebindMask(du_, above), next, index);
  }
  const U at = hn::Add(first, index);
  const V low = gather(sums, at), high = gather(sums, hn::Add(at, set_word(1)));
  const V within = hn::Div(hn::Sub(u, low), hn::Sub(high, low));
  return {index, hn::Min(within, set(0x1.fffffep-1f))};
}

/// EnvmapTable::sample().
struct SkyDirections {
  V3 wi;
  Texels texel;
};
inline HWY_NOINLINE SkyDirections sample_sky(const EnvmapTable& table, V2 u) {
  const SumSteps row = step_of(table.rows.data(), set_word(0), table.height, u.y);
  const auto width = static_cast<std::uint32_t>(table.width);
  const SumSteps column =
      step_of(table.columns.data(), hn::Mul(row.index, set_word(width + 1)), table.width, u.x);
  const V upper = gather(table.upper.data(), row.index),
          lower = gather(table.lower.data(), row.index);
  const V h = mul_add(row.within, hn::Sub(lower, upper), upper);
  const V sine = hn::Sqrt(hn::Max(hn::Mul(h, hn::Sub(set(2), h)), set(0)));
  const V place = hn::Add(hn::ConvertTo(d_, hn::BitCast(di_, column.index)), column.within);
  const SinCos azimuth = turn(hn::Mul(place, set(1 / static_cast<float>(width))));
  const glm::mat3& m = table.rotation;
  const V3 wi = hn::Mul(sine, azimuth.sin) * set(m[0][0], m[0][1], m[0][2]) +
                hn::Mul(gather(table.pole.data(), row.index), hn::Sub(set(1), h)) *
                    set(m[1][0], m[1][1], m[1][2]) -
                hn::Mul(sine, azimuth.cos) * set(m[2][0], m[2][1], m[2][2]);
  return {wi, texels(table, hn::Add(hn::Mul(row.index, set_word(width)), column.index))};
}

}  // namespace HWY_NAMESPACE
}  // namespace renderer
HWY_AFTER_NAMESPACE();

#endif  // CARLO_SKY_INL
