// The modified Phong model, a lane a surface point. Included once for each instruction set.

#if defined(CARLO_BSDF_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef CARLO_BSDF_INL
#undef CARLO_BSDF_INL
#else
#define CARLO_BSDF_INL
#endif

#include "renderer/lanes/vector_math-inl.h"

#include <hwy/contrib/math/math-inl.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace renderer {
namespace HWY_NAMESPACE {

constexpr float pi = 3.14159265358979f;

/// A surface point and what it does with light. Normals stand on the side that is seen.
struct Surfaces {
  V3 p, n, mirror;  ///< mirror: the direction of ideal reflection
  V3 kd, ks;        ///< kd / pi, ks (n + 2) / (2 pi)
  V exponent, diffuse;
};

struct Bsdfs {
  V3 f;
  V pdf;
};

template <bool phong>
HWY_INLINE Bsdfs evaluate(const Surfaces& s, V3 wi, V cosine) {
  const V cosine_pdf = hn::Mul(cosine, set(1 / pi));
  if (!phong) return {s.kd, cosine_pdf};
  // 1 - cos of the angle to the mirror direction, which keeps its digits where the angle is small.
  const V3 apart = wi - s.mirror;
  const V h = hn::Mul(set(0.5f), dot(apart, apart));
  const M front = hn::Lt(h, set(1));
  const V inside = select(front, h, set(0.5f));
  const V power =
      hn::IfThenElseZero(front, hn::Exp(d_, hn::Mul(s.exponent, hn::Log1p(d_, hn::Neg(inside)))));
  const V lobe_pdf = hn::Mul(hn::Mul(hn::Add(s.exponent, set(1)), set(0.5f / pi)), power);
  return {add_scaled(s.kd, power, s.ks),
          hn::MulAdd(s.diffuse, hn::Sub(cosine_pdf, lobe_pdf), lobe_pdf)};
}

/// A direction by either lobe: u.x chooses it and, stretched again, serves the direction.
template <bool phong>
HWY_INLINE V3 sample_direction(const Surfaces& s, V2 u) {
  if (!phong) {
    const SinCos azimuth = turn(u.y);
    const V r = hn::Sqrt(u.x);
    return to_world(frame_about(s.n), hn::Mul(r, azimuth.cos), hn::Mul(r, azimuth.sin),
                    hn::Sqrt(hn::Sub(set(1), u.x)));
  }
  const M is_diffuse = hn::Lt(u.x, s.diffuse);
  const V stretched = hn::Div(select(is_diffuse, u.x, hn::Sub(u.x, s.diffuse)),
                              select(is_diffuse, s.diffuse, hn::Sub(set(1), s.diffuse)));
  const V x = hn::Min(stretched, set(0x1.fffffep-1f));
  const SinCos azimuth = turn(u.y);
  // cos^2 = 1 - x for the cosine's lobe, (1 - x)^(2/(n+1)) for cos^n.
  const V log_cos2 =
      hn::Mul(hn::Log1p(d_, hn::Neg(x)), hn::Div(set(2), hn::Add(s.exponent, set(1))));
  const V sin2 = select(is_diffuse, x, hn::Neg(hn::Expm1(d_, log_cos2)));
  const V cos2 = select(is_diffuse, hn::Sub(set(1), x), hn::Exp(d_, log_cos2));
  const V r = hn::Sqrt(hn::Max(sin2, set(0)));
  const FrameV frame = frame_about(select(is_diffuse, s.n, s.mirror));
  return renormalize(
      to_world(frame, hn::Mul(r, azimuth.cos), hn::Mul(r, azimuth.sin), hn::Sqrt(cos2)));
}

}  // namespace HWY_NAMESPACE
}  // namespace renderer
HWY_AFTER_NAMESPACE();

#endif  // CARLO_BSDF_INL
