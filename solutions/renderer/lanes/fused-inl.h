// Products and sums that are rounded once, a lane a number. Included once for each instruction set.

#if defined(CARLO_FUSED_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef CARLO_FUSED_INL
#undef CARLO_FUSED_INL
#else
#define CARLO_FUSED_INL
#endif

#include <hwy/highway.h>

#include <cstdint>

HWY_BEFORE_NAMESPACE();
namespace renderer {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

#if HWY_NATIVE_FMA

/// a b + c, a b - c, c - a b, -a b - c: floats or doubles. All that this renderer fuses is fused
/// here; the compiler may not (-ffp-contract=off).
template <class Vector>
HWY_INLINE Vector mul_add(Vector a, Vector b, Vector c) {
  return hn::MulAdd(a, b, c);
}
template <class Vector>
HWY_INLINE Vector mul_sub(Vector a, Vector b, Vector c) {
  return hn::MulSub(a, b, c);
}
template <class Vector>
HWY_INLINE Vector neg_mul_add(Vector a, Vector b, Vector c) {
  return hn::NegMulAdd(a, b, c);
}
template <class Vector>
HWY_INLINE Vector neg_mul_sub(Vector a, Vector b, Vector c) {
#if HWY_ARCH_ARM
  // There Highway negates the whole, with the other zero where terms cancel.
  return hn::MulSub(hn::Neg(a), b, c);
#else
  return hn::NegMulSub(a, b, c);
#endif
}

#else

// Machines of before 2013, at a fraction of the speed; calls, so that nobody waits for this code to
// be compiled into every place. Results below 2^-126 (floats) and terms beyond 2^996 or below
// 2^-969 (doubles) may be off by a rounding. Sources: Dekker, "A floating-point technique for
// extending the available precision", 1971; Boldo, Melquiond, "Emulation of FMA and correctly
// rounded sums: proved algorithms using rounding to odd", IEEE Transactions on Computers 57(4),
// 2008.

using Doubles = hn::Vec<hn::Full128<double> >;
using Floats = hn::Vec<hn::Full128<float> >;

/// a + b, rounded, and exactly what that lacks.
struct Sum {
  Doubles rounded, rest;
};
HWY_INLINE Sum exact_sum(Doubles a, Doubles b) {
  const Doubles sum = hn::Add(a, b), of_b = hn::Sub(sum, a);
  return {sum, hn::Add(hn::Sub(a, hn::Sub(sum, of_b)), hn::Sub(b, of_b))};
}

/// a + b rounded to odd: if it is not exact, to that neighbour whose last bit is 1. What is rounded
/// again, to fewer digits, is then right.
HWY_INLINE Doubles odd_sum(Doubles a, Doubles b) {
  const hn::Full128<double> d;
  const hn::Full128<std::int64_t> di;
  const Sum sum = exact_sum(a, b);
  const auto word = hn::BitCast(di, sum.rounded), one = hn::Set(di, 1);
  // The next number in the direction of the rest: away from 0 if both have one sign.
  const auto apart = hn::BroadcastSignBit(hn::Xor(word, hn::BitCast(di, sum.rest)));
  const auto next = hn::Add(word, hn::Or(apart, one));
  const auto even = hn::Eq(hn::And(word, one), hn::Zero(di));
  const auto inexact = hn::Ne(sum.rest, hn::Zero(d));
  return hn::IfThenElse(hn::And(inexact, hn::RebindMask(d, even)), hn::BitCast(d, next),
                        sum.rounded);
}

/// The product of numbers below 2^996 is its rounded value and the rest.
HWY_INLINE Sum exact_product(Doubles a, Doubles b) {
  const Doubles splitter = hn::Set(hn::Full128<double>(), 0x1p27 + 1);
  const auto upper = [&](Doubles x) HWY_ATTR {
    const Doubles scaled = hn::Mul(splitter, x);
    return hn::Sub(scaled, hn::Sub(scaled, x));
  };
  const Doubles a1 = upper(a), a2 = hn::Sub(a, a1), b1 = upper(b), b2 = hn::Sub(b, b1);
  const Doubles product = hn::Mul(a, b);
  const Doubles rest = hn::Add(hn::Sub(hn::Mul(a1, b1), product), hn::Mul(a1, b2));
  return {product, hn::Add(hn::Add(rest, hn::Mul(a2, b1)), hn::Mul(a2, b2))};
}

inline HWY_NOINLINE Doubles mul_add(Doubles a, Doubles b, Doubles c) {
  const Sum product = exact_product(a, b);
  const Sum low = exact_sum(c, product.rest), high = exact_sum(product.rounded, low.rounded);
  const Doubles fused = hn::Add(high.rounded, odd_sum(low.rest, high.rest));
  // The sign of a zero is that of the plain sum; normals have one, and frames about them.
  const hn::Full128<double> d;
  return hn::IfThenElse(hn::Eq(fused, hn::Zero(d)), hn::Add(product.rounded, c), fused);
}

HWY_INLINE Floats narrowed(Doubles low, Doubles high) {
  const hn::Half<hn::Full128<float> > half;
  return hn::Combine(hn::Full128<float>(), hn::DemoteTo(half, high), hn::DemoteTo(half, low));
}

/// Where the sum in doubles lies right between two floats, which of them is nearer it no longer
/// tells, if it was rounded.
HWY_NOINLINE inline Floats odd_narrowed(Doubles p_low, Doubles c_low, Doubles p_high,
                                        Doubles c_high) {
  return narrowed(odd_sum(p_low, c_low), odd_sum(p_high, c_high));
}

inline HWY_NOINLINE Floats mul_add(Floats a, Floats b, Floats c) {
  const hn::Half<hn::Full128<float> > half;
  const hn::Full128<double> dd;
  const hn::Full128<std::uint32_t> du;
  const auto low = [&](Floats x) HWY_ATTR { return hn::PromoteTo(dd, hn::LowerHalf(half, x)); };
  const auto high = [&](Floats x) HWY_ATTR { return hn::PromoteTo(dd, hn::UpperHalf(half, x)); };
  // Exact.
  const Doubles p_low = hn::Mul(low(a), low(b)), p_high = hn::Mul(high(a), high(b));
  const Doubles c_low = low(c), c_high = high(c);
  const Doubles s_low = hn::Add(p_low, c_low), s_high = hn::Add(p_high, c_high);
  // Of the 29 bits that a float does not have, the first alone.
  const auto words = hn::ConcatEven(du, hn::BitCast(du, s_high), hn::BitCast(du, s_low));
  const auto between = hn::Eq(hn::And(words, hn::Set(du, 0x1FFFFFFF)), hn::Set(du, 0x10000000));
  if (HWY_UNLIKELY(!hn::AllFalse(du, between))) return odd_narrowed(p_low, c_low, p_high, c_high);
  return narrowed(s_low, s_high);
}

template <class Vector>
HWY_INLINE Vector mul_sub(Vector a, Vector b, Vector c) {
  return mul_add(a, b, hn::Neg(c));
}
template <class Vector>
HWY_INLINE Vector neg_mul_add(Vector a, Vector b, Vector c) {
  return mul_add(hn::Neg(a), b, c);
}
template <class Vector>
HWY_INLINE Vector neg_mul_sub(Vector a, Vector b, Vector c) {
  return mul_add(hn::Neg(a), b, hn::Neg(c));
}

#endif

}  // namespace HWY_NAMESPACE
}  // namespace renderer
HWY_AFTER_NAMESPACE();

#endif  // CARLO_FUSED_INL
