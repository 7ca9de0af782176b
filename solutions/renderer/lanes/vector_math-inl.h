// Vectors of floats, one path per lane: directions and angles. Included once for each instruction
// set (Highway's foreach_target).

#if defined(CARLO_VECTOR_MATH_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef CARLO_VECTOR_MATH_INL
#undef CARLO_VECTOR_MATH_INL
#else
#define CARLO_VECTOR_MATH_INL
#endif

#include "renderer/lanes/fused-inl.h"

#include <hwy/highway.h>

#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <type_traits>

HWY_BEFORE_NAMESPACE();
namespace renderer {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using D = hn::ScalableTag<float>;
using DU = hn::RebindToUnsigned<D>;
using DI = hn::RebindToSigned<D>;
using V = hn::Vec<D>;
using U = hn::Vec<DU>;
using M = hn::Mask<D>;
constexpr D d_;
constexpr DU du_;
constexpr DI di_;
constexpr std::size_t lanes = hn::MaxLanes(d_);

/// All bits 0. T{} is not zero where Highway's vectors have constructors that leave them
/// uninitialized, as on ARM. Elsewhere T{} is used, since std::memset() takes an address and so
/// keeps the value in memory: that costs a diffuse Cornell box a seventh more instructions.
template <class T>
HWY_INLINE T zeros() {
  if constexpr (std::is_trivially_default_constructible_v<V>) {
    return T{};
  } else {
    T all;
    std::memset(static_cast<void*>(&all), 0, sizeof all);
    return all;
  }
}

HWY_INLINE V set(float x) {
  return hn::Set(d_, x);
}
HWY_INLINE U set_word(std::uint32_t x) {
  return hn::Set(du_, x);
}
HWY_INLINE V select(M m, V yes, V no) {
  return hn::IfThenElse(m, yes, no);
}
HWY_INLINE M select_mask(M m, M yes, M no) {
  return hn::Or(hn::And(m, yes), hn::AndNot(m, no));
}

/// Bit i: lane i.
HWY_INLINE std::uint32_t bits(M mask) {
  // Read with the width of the store: a load that spans two stores waits for both.
  static_assert(lanes <= 16);
  using Word = std::conditional_t<(lanes > 8), std::uint16_t, std::uint8_t>;
  std::array<std::uint8_t, 8> bytes;
  hn::StoreMaskBits(d_, mask, bytes.data());
  Word word;
  std::memcpy(&word, bytes.data(), sizeof word);
  return word;
}

/// For each byte: the number of bits set below each of its bits, in nibbles.
constexpr std::array<std::uint32_t, 256> bits_below = [] {
  std::array<std::uint32_t, 256> below{};
  for (std::uint32_t byte = 0; byte < below.size(); ++byte) {
    for (std::uint32_t i = 0; i < 8; ++i)
      below[byte] |= static_cast<std::uint32_t>(std::popcount(byte & ((1U << i) - 1))) << (4 * i);
  }
  return below;
}();

/// For each lane, the number of lanes before it that are in the mask of these bits.
HWY_INLINE U ranks(std::uint32_t mask) {
  const U lane = hn::Iota(du_, 0);
  U below = set_word(bits_below[mask & 255]), first = set_word(0);
  if constexpr (lanes > 8) {
    const auto high = hn::Gt(lane, set_word(7));
    below = hn::IfThenElse(high, set_word(bits_below[mask >> 8 & 255]), below);
    first =
        hn::IfThenElseZero(high, set_word(static_cast<std::uint32_t>(std::popcount(mask & 255))));
  }
  const U shift = hn::ShiftLeft<2>(hn::And(lane, set_word(7)));
  return hn::Add(hn::And(hn::Shr(below, shift), set_word(15)), first);
}

/// For each byte: the positions of its set bits, in nibbles.
constexpr std::array<std::uint32_t, 256> set_bits = [] {
  std::array<std::uint32_t, 256> places{};
  for (std::uint32_t byte = 0; byte < places.size(); ++byte) {
    std::uint32_t shift = 0;
    for (std::uint32_t i = 0; i < 8; ++i) {
      if ((byte >> i & 1) == 0) continue;
      places[byte] |= i << shift;
      shift += 4;
    }
  }
  return places;
}();

/// Moves the lanes of a mask to the front, in their order; the lanes after them are undefined.
class ToFront {
 public:
  HWY_INLINE explicit ToFront(M mask) : mask_(mask) {
    if constexpr (lanes <= 8) {
      const U shift = hn::ShiftLeft<2>(hn::Iota(du_, 0));
      from_ = hn::And(hn::Shr(set_word(set_bits[bits(mask)]), shift), set_word(lanes - 1));
    }
  }
  // Without an instruction for it, Highway's version copies its table to the stack each time.
  HWY_INLINE V operator()(V v) const {
    if constexpr (lanes > 8) return hn::Compress(v, mask_);
    return hn::TableLookupLanes(v, hn::IndicesFromVec(d_, from_));
  }
  HWY_INLINE U operator()(U u) const { return hn::BitCast(du_, (*this)(hn::BitCast(d_, u))); }

 private:
  M mask_;
  U from_ = hn::Zero(du_);
};

struct V3 {
  V x, y, z;
};
/// A copy, number by number. The compiler keeps these in registers, whereas it would copy a struct
/// within a struct through memory: 3 % of all instructions of a diffuse Cornell box.
HWY_INLINE V3 each(const V3& v) {
  return {v.x, v.y, v.z};
}
HWY_INLINE V3 operator+(V3 a, V3 b) {
  return {hn::Add(a.x, b.x), hn::Add(a.y, b.y), hn::Add(a.z, b.z)};
}
HWY_INLINE V3 operator-(V3 a, V3 b) {
  return {hn::Sub(a.x, b.x), hn::Sub(a.y, b.y), hn::Sub(a.z, b.z)};
}
HWY_INLINE V3 operator*(V3 a, V3 b) {
  return {hn::Mul(a.x, b.x), hn::Mul(a.y, b.y), hn::Mul(a.z, b.z)};
}
HWY_INLINE V3 operator*(V s, V3 a) {
  return {hn::Mul(s, a.x), hn::Mul(s, a.y), hn::Mul(s, a.z)};
}
/// a + s b
HWY_INLINE V3 add_scaled(V3 a, V s, V3 b) {
  return {mul_add(s, b.x, a.x), mul_add(s, b.y, a.y), mul_add(s, b.z, a.z)};
}
HWY_INLINE V dot(V3 a, V3 b) {
  return mul_add(a.x, b.x, mul_add(a.y, b.y, hn::Mul(a.z, b.z)));
}
HWY_INLINE V3 normalize(V3 a) {
  return hn::Div(set(1), hn::Sqrt(dot(a, a))) * a;
}
/// Normalizes a vector whose length is 1 up to rounding: one step of Newton's method.
HWY_INLINE V3 renormalize(V3 a) {
  return neg_mul_add(set(0.5f), dot(a, a), set(1.5f)) * a;
}
HWY_INLINE V3 select(M m, V3 yes, V3 no) {
  return {select(m, yes.x, no.x), select(m, yes.y, no.y), select(m, yes.z, no.z)};
}
HWY_INLINE V3 set(float x, float y, float z) {
  return {set(x), set(y), set(z)};
}
HWY_INLINE V max_element(V3 a) {
  return hn::Max(a.x, hn::Max(a.y, a.z));
}

/// Two vectors at right angles to n and each other, all of length 1.
/// Source: Duff et al., "Building an orthonormal basis, revisited", JCGT 6(1), 2017.
struct FrameV {
  V3 s, t, n;
};
HWY_INLINE FrameV frame_about(V3 n) {
  const V sign = hn::CopySign(set(1), n.z);
  const V a = hn::Neg(hn::Div(set(1), hn::Add(sign, n.z)));
  const V b = hn::Mul(hn::Mul(n.x, n.y), a);
  const V sx = hn::Mul(sign, n.x);
  return {{mul_add(hn::Mul(sx, n.x), a, set(1)), hn::Mul(sign, b), hn::Neg(sx)},
          {b, mul_add(hn::Mul(n.y, n.y), a, sign), hn::Neg(n.y)},
          n};
}
HWY_INLINE V3 to_world(const FrameV& f, V x, V y, V z) {
  return add_scaled(add_scaled(x * f.s, y, f.t), z, f.n);
}

/// Sine and cosine of u whole turns, u in [0, 1). Absolute error below 1e-7.
struct SinCos {
  V sin, cos;
};
HWY_INLINE SinCos turn(V u) {
  // The nearest quarter turn; the rest is at most an eighth of a turn.
  const V quarters = hn::Round(hn::Mul(u, set(4)));
  const V x = hn::Mul(neg_mul_add(quarters, set(0.25f), u), set(6.283185307f)), x2 = hn::Mul(x, x);
  // Taylor's polynomials to x^9 and x^8: the next terms are below 2e-9 and 3e-8 at pi/4.
  V s = mul_add(x2, set(2.755731922e-6f), set(-1.984126984e-4f));
  s = mul_add(mul_add(mul_add(s, x2, set(8.333333333e-3f)), x2, set(-1.666666667e-1f)),
              hn::Mul(x2, x), x);
  V c = mul_add(x2, set(2.480158730e-5f), set(-1.388888889e-3f));
  c = mul_add(mul_add(mul_add(c, x2, set(4.166666667e-2f)), x2, set(-0.5f)), x2, set(1));
  const auto q = hn::ConvertTo(di_, quarters);
  const M odd = hn::RebindMask(d_, hn::Ne(hn::And(q, hn::Set(di_, 1)), hn::Zero(di_)));
  // Signs: the sine changes in quarters 2 and 3, the cosine in 1 and 2.
  const auto sine_sign = hn::ShiftLeft<30>(hn::And(q, hn::Set(di_, 2)));
  const auto cosine_sign = hn::ShiftLeft<30>(hn::And(hn::Add(q, hn::Set(di_, 1)), hn::Set(di_, 2)));
  return {hn::Xor(select(odd, c, s), hn::BitCast(d_, sine_sign)),
          hn::Xor(select(odd, s, c), hn::BitCast(d_, cosine_sign))};
}

struct V2 {
  V x, y;
};

}  // namespace HWY_NAMESPACE
}  // namespace renderer
HWY_AFTER_NAMESPACE();

#endif  // CARLO_VECTOR_MATH_INL
