// Signed distance functions, one point per lane, in double. Included once for each instruction set.

#if defined(CARLO_SDF_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef CARLO_SDF_INL
#undef CARLO_SDF_INL
#else
#define CARLO_SDF_INL
#endif

#include "renderer/lanes/lane_sdf.h"
#include "renderer/lanes/vector_math-inl.h"

#include <hwy/highway.h>

#include <array>
#include <cstddef>

HWY_BEFORE_NAMESPACE();
namespace renderer {
namespace HWY_NAMESPACE {

using DD = hn::ScalableTag<double>;
using VD = hn::Vec<DD>;
using MD = hn::Mask<DD>;
constexpr DD dd_;
constexpr std::size_t doubles = hn::MaxLanes(dd_);

HWY_INLINE VD number(double x) {
  return hn::Set(dd_, x);
}

struct V3D {
  VD x, y, z;
};
HWY_INLINE V3D numbers(glm::dvec3 v) {
  return {number(v.x), number(v.y), number(v.z)};
}
HWY_INLINE V3D operator+(V3D a, V3D b) {
  return {hn::Add(a.x, b.x), hn::Add(a.y, b.y), hn::Add(a.z, b.z)};
}
HWY_INLINE V3D operator-(V3D a, V3D b) {
  return {hn::Sub(a.x, b.x), hn::Sub(a.y, b.y), hn::Sub(a.z, b.z)};
}
HWY_INLINE V3D operator*(VD s, V3D a) {
  return {hn::Mul(s, a.x), hn::Mul(s, a.y), hn::Mul(s, a.z)};
}
HWY_INLINE VD dot(V3D a, V3D b) {
  return mul_add(a.x, b.x, mul_add(a.y, b.y, hn::Mul(a.z, b.z)));
}
HWY_INLINE VD length(V3D a) {
  return hn::Sqrt(dot(a, a));
}
HWY_INLINE V3D select(MD m, V3D yes, V3D no) {
  return {hn::IfThenElse(m, yes.x, no.x), hn::IfThenElse(m, yes.y, no.y),
          hn::IfThenElse(m, yes.z, no.z)};
}
/// m v, and m^T v.
HWY_INLINE V3D turned(const glm::dmat3& m, V3D v) {
  return v.x * numbers(m[0]) + v.y * numbers(m[1]) + v.z * numbers(m[2]);
}
HWY_INLINE V3D turned_back(const glm::dmat3& m, V3D v) {
  return {dot(numbers(m[0]), v), dot(numbers(m[1]), v), dot(numbers(m[2]), v)};
}
HWY_INLINE V3D operator*(V3D a, double s) {
  return number(s) * a;
}
/// 0 where v is 0.
HWY_INLINE V3D direction_of(V3D v) {
  const VD l = length(v);
  const VD inverse = hn::IfThenElseZero(hn::Gt(l, number(0)), hn::Div(number(1), l));
  return inverse * v;
}

/// A distance, and its gradient if `slopes`.
struct Jet {
  VD value;
  V3D gradient;
};

template <bool slopes>
HWY_INLINE Jet ball(const LaneSdf::Step& s, V3D q) {
  Jet jet{hn::Sub(length(q), number(s.size[0])), {}};
  if constexpr (slopes) jet.gradient = direction_of(q);
  return jet;
}

template <bool slopes>
HWY_INLINE Jet torus(const LaneSdf::Step& s, V3D q) {
  const VD from_axis = hn::Sqrt(mul_add(q.x, q.x, hn::Mul(q.y, q.y)));
  const VD from_circle = hn::Sub(from_axis, number(s.size[0]));
  const VD l = hn::Sqrt(mul_add(from_circle, from_circle, hn::Mul(q.z, q.z)));
  Jet jet{hn::Sub(l, number(s.size[1])), {}};
  if constexpr (slopes) {
    const VD share =
        hn::IfThenElse(hn::Gt(from_axis, number(0)), hn::Div(from_circle, from_axis), number(1));
    jet.gradient = direction_of({hn::Mul(q.x, share), hn::Mul(q.y, share), q.z});
  }
  return jet;
}

template <bool slopes>
HWY_INLINE Jet rounded_box(const LaneSdf::Step& s, V3D q) {
  const V3D half = numbers(s.a);
  const VD zero = number(0);
  const V3D b{hn::Sub(hn::Abs(q.x), half.x), hn::Sub(hn::Abs(q.y), half.y),
              hn::Sub(hn::Abs(q.z), half.z)};
  const VD most = hn::Max(b.x, hn::Max(b.y, b.z));
  const V3D beyond{hn::Max(b.x, zero), hn::Max(b.y, zero), hn::Max(b.z, zero)};
  Jet jet{hn::Sub(hn::Add(length(beyond), hn::Min(most, zero)), number(s.size[0])), {}};
  if constexpr (slopes) {
    // Inside the inner box the gradient points to the nearest of its faces.
    const MD within = hn::Le(most, zero);
    const VD one = number(1);
    const MD by_x = hn::Eq(b.x, most), by_y = hn::AndNot(by_x, hn::Eq(b.y, most));
    const V3D nearest{hn::IfThenElseZero(by_x, one), hn::IfThenElseZero(by_y, one),
                      hn::IfThenZeroElse(hn::Or(by_x, by_y), one)};
    const V3D out = select(within, nearest, beyond);
    jet.gradient = direction_of(
        {hn::CopySign(out.x, q.x), hn::CopySign(out.y, q.y), hn::CopySign(out.z, q.z)});
  }
  return jet;
}

template <bool slopes>
HWY_INLINE Jet capsule(const LaneSdf::Step& s, V3D q) {
  const V3D from = q - numbers(s.a), along = numbers(s.b);
  const VD place = hn::Mul(dot(from, along), number(s.size[1]));
  const VD clamped = hn::Min(hn::Max(place, number(0)), number(1));
  const V3D away = from - clamped * along;
  Jet jet{hn::Sub(length(away), number(s.size[0])), {}};
  if constexpr (slopes) jet.gradient = direction_of(away);
  return jet;
}

/// Sine and cosine of u whole turns, |u| below 2^50, to two roundings of 1. The polynomials are
/// those of fdlibm's kernels (Sun Microsystems, 1993).
struct Wave {
  VD sin, cos;
};
HWY_INLINE Wave wave(VD u) {
  // The nearest quarter turn; the rest is at most an eighth of a turn.
  const VD quarters = hn::Round(hn::Mul(u, number(4)));
  const VD x = hn::Mul(neg_mul_add(quarters, number(0.25), u), number(6.283185307179586477)),
           x2 = hn::Mul(x, x);
  const auto next = [x2](VD sum, double term) HWY_ATTR { return mul_add(sum, x2, number(term)); };
  VD s = next(number(1.58969099521155010221e-10), -2.50507602534068634195e-08);
  s = next(next(s, 2.75573137070700676789e-06), -1.98412698298579493134e-04);
  s = next(next(s, 8.33333333332248946124e-03), -1.66666666666666324348e-01);
  s = mul_add(hn::Mul(s, x2), x, x);
  VD c = next(number(-1.13596475577881948265e-11), 2.08757232129817482790e-09);
  c = next(next(c, -2.75573143513906633035e-07), 2.48015872894767294178e-05);
  c = next(next(c, -1.38888888888741095749e-03), 4.16666666666666019037e-02);
  c = next(next(c, -0.5), 1);
  // The number of the quarter, 0 to 3: the sine changes its sign in 2 and 3, the cosine in 1 and 2.
  const VD quarter = neg_mul_add(number(4), hn::Floor(hn::Mul(quarters, number(0.25))), quarters);
  const MD odd = hn::Eq(hn::Abs(hn::Sub(quarter, number(2))), number(1));
  const MD middle = hn::Lt(hn::Abs(hn::Sub(quarter, number(1.5))), number(1));
  const VD sine = hn::IfThenElse(odd, c, s), cosine = hn::IfThenElse(odd, s, c);
  return {hn::IfThenElse(hn::Ge(quarter, number(2)), hn::Neg(sine), sine),
          hn::IfThenElse(middle, hn::Neg(cosine), cosine)};
}

template <bool slopes>
HWY_INLINE Jet gyroid(const LaneSdf::Step& s, V3D q) {
  const V3D turns = q * s.size[0];
  const Wave x = wave(turns.x), y = wave(turns.y), z = wave(turns.z);
  const VD g = dot({x.sin, y.sin, z.sin}, {y.cos, z.cos, x.cos});
  Jet jet{mul_sub(hn::Abs(g), number(s.size[2]), number(s.size[1])), {}};
  if constexpr (slopes) {
    const V3D slope{mul_sub(x.cos, y.cos, hn::Mul(z.sin, x.sin)),
                    mul_sub(y.cos, z.cos, hn::Mul(x.sin, y.sin)),
                    mul_sub(z.cos, x.cos, hn::Mul(y.sin, z.sin))};
    constexpr double per_root_3 = 0.577350269189625765;  // makes the largest slope on the surface 1
    jet.gradient = hn::CopySign(number(per_root_3), g) * slope;
  }
  return jet;
}

template <bool slopes>
HWY_INLINE Jet negated(const Jet& a) {
  Jet jet{hn::Neg(a.value), {}};
  if constexpr (slopes) jet.gradient = number(-1) * a.gradient;
  return jet;
}

/// carlo::sdf::Combine's minimum, smoothed by k.
template <bool slopes>
HWY_INLINE Jet minimum(const Jet& a, const Jet& b, double k) {
  VD overlap = number(0);
  if (k > 0) {
    overlap = hn::Max(neg_mul_add(hn::Abs(hn::Sub(a.value, b.value)), number(1 / k), number(1)),
                      number(0));
  }
  Jet jet{neg_mul_add(hn::Mul(number(0.25 * k), overlap), overlap, hn::Min(a.value, b.value)), {}};
  if constexpr (slopes) {
    const VD other = hn::Mul(number(0.5), overlap);
    const VD of_b = hn::IfThenElse(hn::Lt(a.value, b.value), other, hn::Sub(number(1), other));
    jet.gradient = hn::Sub(number(1), of_b) * a.gradient + of_b * b.gradient;
  }
  return jet;
}

template <bool slopes>
HWY_INLINE Jet form(const LaneSdf::Step& s, V3D q) {
  switch (s.part) {
    case LaneSdf::Part::ball:
      return ball<slopes>(s, q);
    case LaneSdf::Part::torus:
      return torus<slopes>(s, q);
    case LaneSdf::Part::rounded_box:
      return rounded_box<slopes>(s, q);
    case LaneSdf::Part::capsule:
      return capsule<slopes>(s, q);
    case LaneSdf::Part::gyroid:
      return gyroid<slopes>(s, q);
    case LaneSdf::Part::unite:
    case LaneSdf::Part::intersect:
    case LaneSdf::Part::subtract:
      break;  // these are no forms
  }
  return {number(0), {number(0), number(0), number(0)}};
}

/// F at points in its own coordinates. Several registers are evaluated at a time, so that one fills
/// the other's waiting times, as for square roots.
template <bool slopes, std::size_t ways>
HWY_NOINLINE void evaluate(const LaneSdf& sdf, const std::array<V3D, ways>& p,
                           std::array<Jet, ways>& jets) {
  std::array<std::array<Jet, ways>, carlo::sdf::most_waiting> stack;
  auto* end = stack.data();
  for (const LaneSdf::Step& s : sdf.steps) {
    if (s.part < LaneSdf::Part::unite) {
      for (std::size_t w = 0; w < ways; ++w) {
        Jet jet = form<slopes>(s, turned(s.turn, p[w] - numbers(s.origin)));
        jet.value = hn::Mul(jet.value, number(s.scale));
        // The gradient of scale F(turn p), where turn is a rotation over the scale.
        if constexpr (slopes) jet.gradient = turned_back(s.turn, jet.gradient) * s.scale;
        (*end)[w] = jet;
      }
      ++end;
      continue;
    }
    --end;
    for (std::size_t w = 0; w < ways; ++w) {
      Jet& a = end[-1][w];
      const Jet& b = (*end)[w];
      if (s.part == LaneSdf::Part::unite) {
        a = minimum<slopes>(a, b, s.smoothing);
      } else {
        const bool both = s.part == LaneSdf::Part::intersect;
        const Jet inner = both ? negated<slopes>(b) : b;
        a = negated<slopes>(minimum<slopes>(negated<slopes>(a), inner, s.smoothing));
      }
    }
  }
  jets = stack[0];
}
template <bool slopes>
HWY_INLINE Jet evaluate(const LaneSdf& sdf, const V3D& p) {
  std::array<Jet, 1> jet;
  evaluate<slopes, 1>(sdf, {p}, jet);
  return jet[0];
}

}  // namespace HWY_NAMESPACE
}  // namespace renderer
HWY_AFTER_NAMESPACE();

#endif  // CARLO_SDF_INL
