// Products and sums with a single rounding, one number per lane. Included once for each instruction
// set.

#if defined(CARLO_FUSED_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef CARLO_FUSED_INL
#undef CARLO_FUSED_INL
#else
#define CARLO_FUSED_INL
#endif

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace renderer {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// a b + c, a b - c, c - a b, -a b - c, for floats or doubles. All fused operations of this
/// renderer are here; the compiler may not fuse (-ffp-contract=off). Instruction sets without FMA,
/// for which Highway rounds twice, have no kernel (lane_kernel.cpp).
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
  // Highway negates the whole here, which gives the other zero where terms cancel.
  return hn::MulSub(hn::Neg(a), b, c);
#else
  return hn::NegMulSub(a, b, c);
#endif
}

}  // namespace HWY_NAMESPACE
}  // namespace renderer
HWY_AFTER_NAMESPACE();

#endif  // CARLO_FUSED_INL
