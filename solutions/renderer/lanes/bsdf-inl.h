// The modified Phong model, one surface point per lane. Included once for each instruction set.

#if defined(CARLO_BSDF_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef CARLO_BSDF_INL
#undef CARLO_BSDF_INL
#else
#define CARLO_BSDF_INL
#endif

#include "renderer/lanes/elementary-inl.h"
#include "renderer/lanes/vector_math-inl.h"

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace renderer {
namespace HWY_NAMESPACE {

constexpr float pi = 3.14159265358979f;

/// A surface point and its reflection properties. Normals are on the visible side.
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
  if (!phong) return {each(s.kd), cosine_pdf};
  // 1 - cos of the angle to the mirror direction, accurate even where the angle is small.
  const V3 apart = wi - s.mirror;
  const V h = hn::Mul(set(0.5f), dot(apart, apart));
  const M front = hn::Lt(h, set(1));
  const V inside = select(front, h, set(0.5f));
  const V power = hn::IfThenElseZero(front, exp_of(hn::Mul(s.exponent, log_one_minus(inside))));
  const V lobe_pdf = hn::Mul(hn::Mul(hn::Add(s.exponent, set(1)), set(0.5f / pi)), power);
  return {add_scaled(s.kd, power, s.ks),
          mul_add(s.diffuse, hn::Sub(cosine_pdf, lobe_pdf), lobe_pdf)};
}

/// The density with which a path that arrives along the sampled direction (cosine `cosine`, density
/// `pdf`) would sample the direction of arrival (cosine `arrival`). The lobe is symmetric.
template <bool phong>
HWY_INLINE V reverse_pdf_of(const Surfaces& s, V arrival, V cosine, V pdf) {
  const V per_pi = set(1 / pi);
  if (!phong) return hn::Mul(arrival, per_pi);
  const V more = hn::Mul(s.diffuse, hn::Mul(hn::Sub(arrival, cosine), per_pi));
  return hn::Max(hn::Add(pdf, more), set(0));
}

/// Samples a direction: u.x chooses the lobe and is rescaled to sample the direction, too.
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
  // cos^2 = 1 - x for the cosine lobe, (1 - x)^(2/(n+1)) for cos^n.
  const V log_cos2 = hn::Mul(log_one_minus(x), hn::Div(set(2), hn::Add(s.exponent, set(1))));
  const Exponential e = exponential(log_cos2);
  const V sin2 = select(is_diffuse, x, neg_mul_add(e.scale, e.more, hn::Sub(set(1), e.scale)));
  const V cos2 = select(is_diffuse, hn::Sub(set(1), x), mul_add(e.scale, e.more, e.scale));
  const V r = hn::Sqrt(hn::Max(sin2, set(0)));
  const FrameV frame = frame_about(select(is_diffuse, s.n, s.mirror));
  return renormalize(
      to_world(frame, hn::Mul(r, azimuth.cos), hn::Mul(r, azimuth.sin), hn::Sqrt(cos2)));
}

/// Reflection by mirrors, reflection or refraction by glass.
struct Reflections {
  V3 d;
  V3 weight;
  V eta2;     ///< the scaling of radiance by refraction: part of `weight`, but no absorption
  M through;  ///< transmitted
};

/// Reflects or refracts rays of direction d; n is on the side that they come from, which is the
/// outer one if `front`. `ior`: inner index over outer index, 0 for mirrors, which reflect
/// `reflectance`. Glass reflects where u is below Fresnel's reflectance for unpolarised light.
HWY_INLINE Reflections reflect(V3 d, V3 n, M front, V3 reflectance, V ior, V u) {
  const M glass = hn::Gt(ior, set(0));
  const V inner = select(glass, ior, set(1));
  const V eta = select(front, hn::Div(set(1), inner), inner);
  const V cos_o = hn::Min(hn::Neg(dot(n, d)), set(1));
  const V sin2_t = hn::Mul(hn::Mul(eta, eta), neg_mul_add(cos_o, cos_o, set(1)));
  const V cos_t = hn::Sqrt(hn::Max(hn::Sub(set(1), sin2_t), set(0)));
  const V parallel = hn::Div(neg_mul_add(eta, cos_t, cos_o), mul_add(eta, cos_t, cos_o));
  const V perpendicular = hn::Div(mul_sub(eta, cos_o, cos_t), mul_add(eta, cos_o, cos_t));
  const V fresnel =
      hn::Mul(set(0.5f), mul_add(parallel, parallel, hn::Mul(perpendicular, perpendicular)));
  const M through = hn::And(glass, hn::And(hn::Lt(sin2_t, set(1)), hn::Ge(u, fresnel)));
  const V3 mirrored = add_scaled(d, hn::Add(cos_o, cos_o), n);
  const V3 refracted = add_scaled(eta * d, mul_sub(eta, cos_o, cos_t), n);
  const V eta2 = select(through, hn::Mul(eta, eta), set(1));
  return {normalize(select(through, refracted, mirrored)),
          select(glass, {eta2, eta2, eta2}, reflectance), eta2, through};
}

}  // namespace HWY_NAMESPACE
}  // namespace renderer
HWY_AFTER_NAMESPACE();

#endif  // CARLO_BSDF_INL
