// Logarithm, exponential and arc tangent, one number per lane: the same bits on every instruction
// set and with every release of Highway. Included once for each instruction set.

#if defined(CARLO_ELEMENTARY_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef CARLO_ELEMENTARY_INL
#undef CARLO_ELEMENTARY_INL
#else
#define CARLO_ELEMENTARY_INL
#endif

#include "renderer/lanes/vector_math-inl.h"

#include <hwy/highway.h>

#include <array>
#include <cstddef>

HWY_BEFORE_NAMESPACE();
namespace renderer {
namespace HWY_NAMESPACE {

/// Evaluates a polynomial, lowest coefficient first, as the even powers plus x times the odd ones,
/// which do not wait for each other.
template <std::size_t n>
HWY_INLINE V polynomial(V x, V x2, const std::array<float, n>& coefficients) {
  const auto every_second = [&](std::size_t i) HWY_ATTR {
    V sum = set(coefficients[i]);
    for (; i >= 2; i -= 2)
      sum = mul_add(sum, x2, set(coefficients[i - 2]));
    return sum;
  };
  constexpr std::size_t last = n - 1;
  const V a = every_second(last), b = every_second(last - 1);
  return last % 2 == 0 ? mul_add(b, x, a) : mul_add(a, x, b);
}

constexpr float ln_2 = 0.6931471806f, ln_2_rest = -1.904654323e-9f;

/// log(1 - x), x from 0 to 1 - 2^-24, to two units in the last place.
HWY_INLINE V log_one_minus(V x) {
  // (1 - x) / 2^k lies between the roots of 1/2 and 2; f is its distance from 1, rounded once.
  const auto k =
      hn::ShiftRight<23>(hn::Sub(hn::BitCast(di_, hn::Sub(set(1), x)), hn::Set(di_, 0x3F3504F3)));
  const V scale = hn::BitCast(d_, hn::ShiftLeft<23>(hn::Sub(hn::Set(di_, 127), k)));
  const V f = neg_mul_add(x, scale, hn::Sub(scale, set(1))), f2 = hn::Mul(f, f);
  // log(1 + f) = f + f^2 times this polynomial, which interpolates at Chebyshev nodes: relative
  // error 2e-8.
  constexpr std::array by_f2{-0.5f,          0.3333333073f,  -0.2500030642f,
                             0.2000104509f,  -0.1664128146f, 0.1421449592f,
                             -0.1299818376f, 0.1262231985f,  -0.07902743772f};
  const V turns = hn::ConvertTo(d_, k);
  const V small = mul_add(f2, polynomial(f, f2, by_f2), hn::Mul(turns, set(ln_2_rest)));
  return mul_add(turns, set(ln_2), hn::Add(f, small));
}

/// e^x as scale (1 + more), where scale is a power of 2, for x from -86 to 0. Accurate to two units
/// in the last place; so is e^x - 1 if the two are combined without loss.
struct Exponential {
  V scale, more;
};
HWY_INLINE Exponential exponential(V x) {
  const auto k = hn::NearestInt(hn::Mul(x, set(1.442695041f)));
  const V turns = hn::ConvertTo(d_, k);
  const V r = neg_mul_add(turns, set(ln_2_rest), neg_mul_add(turns, set(ln_2), x));
  const V r2 = hn::Mul(r, r);
  // e^r - 1 = r + r^2 times this polynomial: minimax, relative error 4e-9.
  constexpr std::array by_r2{
      0.5f, 0.1666663577f, 0.04166651244f, 0.008341641022f, 0.001393040719f, 0.0001490547721f};
  return {hn::BitCast(d_, hn::ShiftLeft<23>(hn::Add(k, hn::Set(di_, 127)))),
          mul_add(r2, polynomial(r, r2, by_r2), r)};
}

/// e^x for x up to 0; 0 below -86.
HWY_INLINE V exp_of(V x) {
  const Exponential e = exponential(x);
  return hn::IfThenElseZero(hn::Ge(x, set(-86)), mul_add(e.scale, e.more, e.scale));
}

/// The angle whose tangent is x, x from 0 to 1, in whole turns, to four units in the last place.
HWY_INLINE V turns_of_tangent(V x) {
  const V x2 = hn::Mul(x, x);
  // Minimax, relative error 2e-8.
  constexpr std::array by_x{0.1591549407f,   -0.05305123394f,  0.03181924235f,
                            -0.02260580419f, 0.01693557797f,   -0.01194346393f,
                            0.006794572677f, -0.002557403878f, 0.0004535741781f};
  return hn::Mul(x, polynomial(x2, hn::Mul(x2, x2), by_x));
}

}  // namespace HWY_NAMESPACE
}  // namespace renderer
HWY_AFTER_NAMESPACE();

#endif  // CARLO_ELEMENTARY_INL
