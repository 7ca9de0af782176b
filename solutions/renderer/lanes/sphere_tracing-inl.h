// Finds the intersections of rays with signed distance functions. Included once for each
// instruction set.

#if defined(CARLO_SPHERE_TRACING_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef CARLO_SPHERE_TRACING_INL
#undef CARLO_SPHERE_TRACING_INL
#else
#define CARLO_SPHERE_TRACING_INL
#endif

#include "renderer/lanes/lane_sdf.h"
#include "renderer/lanes/march-inl.h"
#include "renderer/lanes/sdf-inl.h"
#include "renderer/lanes/sdf_rays-inl.h"
#include "renderer/lanes/vector_math-inl.h"

#include <hwy/highway.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

HWY_BEFORE_NAMESPACE();
namespace renderer {
namespace HWY_NAMESPACE {

/// The next numbers, from `begin` on, of a list of length `end`; repeats the last one past the end.
HWY_INLINE VL some_of(const SdfRays::Row<std::int64_t>& list, std::size_t begin, std::size_t end) {
  alignas(64) std::array<std::int64_t, doubles> numbers;
  for (std::size_t k = 0; k < doubles; ++k)
    numbers[k] = list[std::min(begin + k, end - 1)];
  return hn::Load(dl_, numbers.data());
}

/// Values of F of different signs, at a and b.
struct Brackets {
  VD a, b, f_a, f_b;
};

/// Finds the roots in between, to F's resolution (`fine`), by secants: the value at an end that
/// stays is halved (the "Illinois" rule), so that both ends move; by bisection when that takes
/// long. Source: Dowell, Jarratt, "A modified regula falsi method for computing the root of an
/// equation", 1971.
HWY_INLINE VD narrowed(const LaneSdf& sdf, const V3D& o, const V3D& d, VD fine, Brackets x) {
  MD wanted = hn::FirstN(dd_, doubles);
  VD best = x.b;
  for (int i = 0; i < 100 && !hn::AllFalse(dd_, wanted); ++i) {
    const VD by_secant =
        hn::Div(neg_mul_add(x.b, x.f_a, hn::Mul(x.a, x.f_b)), hn::Sub(x.f_b, x.f_a));
    const VD low = hn::Min(x.a, x.b), high = hn::Max(x.a, x.b);
    const VD middle = mul_add(hn::Sub(high, low), number(0.5), low);
    // A division by 0 gives a value for which no comparison holds.
    const MD inside = hn::And(hn::Ge(by_secant, low), hn::Le(by_secant, high));
    const VD next = i < 30 ? hn::IfThenElse(inside, by_secant, middle) : middle;
    const VD f = evaluate<false>(sdf, at(o, d, next)).value;
    best = hn::IfThenElse(wanted, next, best);
    const MD crosses = hn::Lt(hn::Mul(f, x.f_b), number(0));
    x.a = hn::IfThenElse(crosses, x.b, x.a);
    x.f_a = hn::IfThenElse(crosses, x.f_b, i < 30 ? hn::Mul(number(0.5), x.f_a) : x.f_a);
    x.b = next;
    x.f_b = f;
    const MD done = hn::Or(hn::Le(hn::Abs(f), hn::Mul(number(0.25), fine)),
                           hn::Le(hn::Abs(hn::Sub(x.b, x.a)), fine));
    wanted = hn::AndNot(done, wanted);
  }
  return best;
}

/// Fills SdfRays::s.
inline HWY_NOINLINE void trace(const LaneSdf& sdf, SdfRays& rays) {
  prepare(sdf, rays);
  SdfRays::Row<std::int64_t> found;
  const std::size_t count = March(sdf, rays).run(found);
  for (std::size_t i = 0; i < count; i += doubles) {
    const VL ray = some_of(found, i, count);
    const Brackets bracket{rays.of(rays.a, ray), rays.of(rays.b, ray), rays.of(rays.f_a, ray),
                           rays.of(rays.f_b, ray)};
    alignas(64) std::array<double, doubles> s;
    hn::Store(
        narrowed(sdf, rays.origins(ray), rays.directions(ray), rays.of(rays.fine, ray), bracket),
        dd_, s.data());
    for (std::size_t k = 0; k < doubles && i + k < count; ++k)
      rays.s[static_cast<std::size_t>(found[i + k])] = s[k];
  }
}

/// Points where a register's rays hit sdfs, rounded once, and their unit normals.
struct SdfPoints {
  alignas(64) std::array<float, lanes> px{}, py{}, pz{}, nx{}, ny{}, nz{};
};

/// `rays` met the sdf at SdfRays::s.
inline HWY_NOINLINE void points_of(const LaneSdf& sdf, const SdfRays& rays, SdfPoints& points) {
  constexpr hn::Rebind<float, DD> half;
  const auto& place = sdf.place;
  for (std::size_t i = 0; i < rays.count; i += doubles) {
    const V3D d = rays.directions(i), q = at(rays.origins(i), d, rays.of(rays.s, i));
    const V3D gradient = evaluate<true>(sdf, q).gradient;
    // Where two surfaces just touch there is no normal: use one that faces the ray.
    const MD known = hn::Gt(dot(gradient, gradient), number(0));
    const V3D out = select(known, direction_of(gradient), number(-1) * d);
    const V3D n = turned(place.rotation, out) * (sdf.flipped ? -1 : 1);
    const V3D p = numbers(place.origin) + turned(place.rotation, q) * place.scale;
    const auto put = [&](VD v, std::array<float, lanes>& row) HWY_ATTR {
      alignas(64) std::array<float, doubles> values;
      hn::Store(hn::DemoteTo(half, v), half, values.data());
      for (std::size_t k = 0; k < doubles && i + k < rays.count; ++k)
        row[rays.lane[i + k]] = values[k];
    };
    put(p.x, points.px), put(p.y, points.py), put(p.z, points.pz);
    put(n.x, points.nx), put(n.y, points.ny), put(n.z, points.nz);
  }
}

/// Returns those of the `wanted` rays o + t d, t up to `longest`, that may come near the sdf.
HWY_INLINE M near_sdf(const LaneSdf& sdf, V3 o, V3 d, V longest, M wanted) {
  const auto f = [](double x) HWY_ATTR { return set(static_cast<float>(x)); };
  const glm::dmat3& r = sdf.place.rotation;
  const V inverse = f(1 / sdf.place.scale);
  const V3 from = inverse * (o - set(static_cast<float>(sdf.place.origin.x),
                                     static_cast<float>(sdf.place.origin.y),
                                     static_cast<float>(sdf.place.origin.z)));
  // Many times the possible rounding error of the coordinates.
  const V margin =
      mul_add(set(1e-5f),
              hn::Add(hn::Mul(inverse, hn::Add(hn::Abs(o.x), hn::Add(hn::Abs(o.y), hn::Abs(o.z)))),
                      f(glm::length(sdf.place.origin) / sdf.place.scale)),
              f(1e-5 * sdf.reach));
  V begin = set(0), end = hn::Mul(longest, inverse);
  for (int k = 0; k < 3; ++k) {
    const V3 axis =
        set(static_cast<float>(r[k].x), static_cast<float>(r[k].y), static_cast<float>(r[k].z));
    const V at_axis = dot(axis, from), along = hn::Or(dot(axis, d), set(0x1p-63f));
    const V per_along = hn::Div(set(1), along);
    const V a = hn::Mul(hn::Sub(hn::Sub(f(sdf.box.lower[k]), margin), at_axis), per_along),
            b = hn::Mul(hn::Sub(hn::Add(f(sdf.box.upper[k]), margin), at_axis), per_along);
    begin = hn::Max(begin, hn::Min(a, b));
    end = hn::Min(end, hn::Max(a, b));
  }
  // Dividing by small numbers has cost large quotients a few digits.
  return hn::And(wanted, hn::Le(hn::Mul(begin, set(1 - 1e-5f)), hn::Mul(end, set(1 + 1e-5f))));
}

HWY_INLINE void rays_near(const LaneSdf& sdf, V3 o, V3 d, V longest, M wanted,
                          std::size_t first_lane, SdfRays& rays) {
  const M near = near_sdf(sdf, o, d, longest, wanted);
  if (!hn::AllFalse(d_, near)) rays.add(o, d, longest, near, first_lane);
}

}  // namespace HWY_NAMESPACE
}  // namespace renderer
HWY_AFTER_NAMESPACE();

#endif  // CARLO_SPHERE_TRACING_INL
