// Where rays meet signed distance functions. Included once for each instruction set.

#if defined(CARLO_SPHERE_TRACING_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef CARLO_SPHERE_TRACING_INL
#undef CARLO_SPHERE_TRACING_INL
#else
#define CARLO_SPHERE_TRACING_INL
#endif

#include "geometry/sphere_tracer.h"
#include "renderer/lanes/lane_sdf.h"
#include "renderer/lanes/sdf-inl.h"
#include "renderer/lanes/vector_math-inl.h"

#include <hwy/highway.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

HWY_BEFORE_NAMESPACE();
namespace renderer {
namespace HWY_NAMESPACE {

/// So many registers of paths walk together where there are sdfs: of each register few rays come
/// near to one, and these take steps of very different numbers.
constexpr std::size_t batch = 32;

using DL = hn::RebindToSigned<DD>;
using VL = hn::Vec<DL>;
constexpr DL dl_;

/// Some of a batch's rays, one after the other, in an sdf's coordinates: o + s d, |d| = 1.
struct SdfRays {
  template <class T>
  using Row = std::array<T, batch * lanes>;
  Row<double> ox, oy, oz, dx, dy, dz, end, t_per_s;
  Row<double> s;               ///< where they meet it; below 0: nowhere
  Row<double> a, b, f_a, f_b;  ///< first there are values of F between, of different signs
  Row<std::uint32_t> lane;     ///< of the batch
  std::size_t count = 0;

  /// The ray o + t d, t up to `longest`.
  void add(const LaneSdf& sdf, std::uint32_t of_lane, glm::vec3 o, glm::vec3 d, float longest) {
    const glm::dvec3 from = sdf.place.inverse(glm::dvec3(o));
    const glm::dvec3 turned = glm::transpose(sdf.place.rotation) * glm::dvec3(d);
    const double length = glm::length(turned);
    ox[count] = from.x, oy[count] = from.y, oz[count] = from.z;
    dx[count] = turned.x / length, dy[count] = turned.y / length, dz[count] = turned.z / length;
    t_per_s[count] = sdf.place.scale / length;
    end[count] = static_cast<double>(longest) / t_per_s[count];
    s[count] = -1;
    lane[count++] = of_lane;
  }
  HWY_INLINE V3D origins(VL i) const { return {of(ox, i), of(oy, i), of(oz, i)}; }
  HWY_INLINE V3D directions(VL i) const { return {of(dx, i), of(dy, i), of(dz, i)}; }
  HWY_INLINE VD of(const Row<double>& row, VL i) const {
    return hn::GatherIndex(dd_, row.data(), i);
  }
};

/// The first numbers of a list from `begin` on, or its last again where it has no more.
template <class List>
HWY_INLINE VL some_of(const List& list, std::size_t begin, std::size_t end) {
  alignas(64) std::array<std::int64_t, doubles> numbers;
  for (std::size_t k = 0; k < doubles; ++k)
    numbers[k] = list(std::min(begin + k, end - 1));
  return hn::Load(dl_, numbers.data());
}

HWY_INLINE V3D at(const V3D& o, const V3D& d, VD s) {
  return {mul_add(s, d.x, o.x), mul_add(s, d.y, o.y), mul_add(s, d.z, o.z)};
}

/// How exactly a point of a ray from o can be known to lie on the surface: 64 roundings of the
/// largest number on the way.
HWY_INLINE VD resolution(const LaneSdf& sdf, const V3D& o) {
  return hn::Mul(number(0x1p-46), hn::Add(length(o), number(sdf.reach)));
}

/// Values of F of different signs, at a and b.
struct Brackets {
  VD a, b, f_a, f_b;
};

/// The roots between, to F's resolution, by secants: the end that stays counts half from then on
/// (the "Illinois" rule), so that both ends move; by halves when that takes long.
/// Source: Dowell, Jarratt, "A modified regula falsi method for computing the root of an equation",
/// 1971.
HWY_INLINE VD narrowed(const LaneSdf& sdf, const V3D& o, const V3D& d, Brackets x) {
  MD wanted = hn::FirstN(dd_, doubles);
  const VD fine = resolution(sdf, o);
  VD best = x.b;
  for (int i = 0; i < 100 && !hn::AllFalse(dd_, wanted); ++i) {
    const VD by_secant =
        hn::Div(neg_mul_add(x.b, x.f_a, hn::Mul(x.a, x.f_b)), hn::Sub(x.f_b, x.f_a));
    const VD low = hn::Min(x.a, x.b), high = hn::Max(x.a, x.b);
    const VD middle = mul_add(hn::Sub(high, low), number(0.5), low);
    // A division by 0 is a value that no comparison holds for.
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

/// The part of [begin, end] in which rays are inside of the sdf's box.
HWY_INLINE void clip(const LaneSdf& sdf, const V3D& o, const V3D& d, VD& begin, VD& end) {
  const auto slab = [&](VD from, VD along, double lower, double upper) HWY_ATTR {
    // A component of 0 becomes one so small that no quotient is 0 / 0.
    const VD inverse =
        hn::Div(number(1), hn::IfThenElse(hn::Eq(along, number(0)), number(0x1p-1000), along));
    const VD a = hn::Mul(hn::Sub(number(lower), from), inverse),
             b = hn::Mul(hn::Sub(number(upper), from), inverse);
    begin = hn::Max(begin, hn::Min(a, b));
    end = hn::Min(end, hn::Max(a, b));
  };
  slab(o.x, d.x, sdf.box.lower.x, sdf.box.upper.x);
  slab(o.y, d.y, sdf.box.lower.y, sdf.box.upper.y);
  slab(o.z, d.z, sdf.box.lower.z, sdf.box.upper.z);
}

/// SphereTracer::first_root() in lanes, as far as to values of F of different signs. A lane whose
/// ray has come to its end takes the next.
class March {
 public:
  HWY_INLINE March(const LaneSdf& sdf, SdfRays& rays) : sdf_(sdf), rays_(rays) { ray_.fill(0); }

  /// The rays with such values; the number of them.
  HWY_INLINE std::size_t run(SdfRays::Row<std::int64_t>& found) {
    std::size_t count = 0;
    for (;;) {
      if (next_ray_ < rays_.count && 4 * hn::CountTrue(dd_, going_) <= 3 * doubles) refill();
      if (hn::AllFalse(dd_, going_)) {
        if (next_ray_ < rays_.count) continue;
        return count;
      }
      const VD safe = hn::Max(hn::Abs(f_), least_);
      const VD step = hn::Div(hn::Add(safe, safe), hn::Sub(number(1), slope_));
      const VD next = hn::Min(hn::Add(s_, step), end_);
      const VD x = hn::IfThenElse(fresh_, s_, next), way = hn::Sub(x, s_);
      const VD f = evaluate<false>(sdf_, at(o_, d_, x)).value;
      const MD walking = hn::AndNot(fresh_, going_);
      // A step of more than is safe stands if the balls around both ends leave no gap, or none that
      // counts: the last one before the surface crosses it.
      const VD beyond = hn::Mul(f, side_);
      const MD longer = hn::And(
          walking, hn::And(hn::Gt(slope_, number(-1)), hn::Gt(way, hn::Add(least_, least_))));
      const MD gap = hn::And(longer, hn::Gt(way, hn::Add(hn::Abs(f_), beyond)));
      const MD stands = hn::AndNot(gap, walking);
      const MD crossed = hn::And(stands, hn::Lt(beyond, number(0)));
      if (!hn::AllFalse(dd_, crossed)) keep(crossed, x, f, found, count);
      const MD over = hn::AndNot(hn::Lt(x, end_), stands);  // NaN ends, too
      going_ = hn::AndNot(hn::Or(crossed, over), going_);
      const VD rise = hn::Div(hn::Sub(beyond, hn::Mul(f_, side_)), way);
      const VD mean = mul_add(number(0.3), rise, hn::Mul(number(0.7), slope_));
      slope_ = hn::IfThenElse(stands, hn::Min(mean, number(most_slope)), number(-1));
      const MD moves = hn::Not(gap);
      s_ = hn::IfThenElse(moves, x, s_);
      f_ = hn::IfThenElse(moves, f, f_);
      if (!hn::AllFalse(dd_, fresh_)) start();
      steps_ = hn::Add(steps_, number(1));
      const MD slow = hn::Ge(steps_, number(carlo::SphereTracer::steps_to_doubling));
      least_ = hn::IfThenElse(slow, hn::Add(least_, least_), least_);
      steps_ = hn::IfThenZeroElse(slow, steps_);
    }
  }

 private:
  /// Rays for the lanes that have none.
  HWY_INLINE void refill() {
    std::array<std::uint8_t, 8> taken{};
    hn::StoreMaskBits(dd_, going_, taken.data());
    std::uint8_t taking = 0;
    for (std::size_t k = 0; k < doubles && next_ray_ < rays_.count; ++k) {
      if ((taken[0] >> k & 1) != 0) continue;
      ray_[k] = static_cast<std::int64_t>(next_ray_++);
      taking = static_cast<std::uint8_t>(taking | 1u << k);
    }
    taken.fill(0);
    taken[0] = taking;
    fresh_ = hn::LoadMaskBits(dd_, taken.data());
    const VL ray = hn::Load(dl_, ray_.data());
    o_ = rays_.origins(ray);
    d_ = rays_.directions(ray);
    VD begin = number(0);
    end_ = rays_.of(rays_.end, ray);
    clip(sdf_, o_, d_, begin, end_);
    fine_ = resolution(sdf_, o_);
    const VD least =
        hn::Max(number(carlo::SphereTracer::least_step * sdf_.size), hn::Mul(number(4), fine_));
    s_ = hn::IfThenElse(fresh_, begin, s_);
    least_ = hn::IfThenElse(fresh_, least, least_);
    steps_ = hn::IfThenZeroElse(fresh_, steps_);
    fresh_ = hn::And(fresh_, hn::Lt(begin, end_));
    going_ = hn::Or(going_, fresh_);
  }

  /// The side of the surface on which fresh rays start, from F there: if they start on the surface,
  /// the one that they go to; before the sdf's box, outside.
  HWY_INLINE void start() {
    const VD zero = number(0);
    const MD before = hn::Gt(s_, zero);
    MD outside = hn::Or(before, hn::Gt(f_, zero));
    const MD on_surface = hn::And(fresh_, hn::AndNot(before, hn::Le(hn::Abs(f_), fine_)));
    if (!hn::AllFalse(dd_, on_surface)) {
      const V3D gradient = evaluate<true>(sdf_, at(o_, d_, s_)).gradient;
      const MD leaves = hn::Ge(dot(gradient, d_), zero);
      outside = hn::Or(hn::And(on_surface, leaves), hn::AndNot(on_surface, outside));
      f_ = hn::IfThenElse(on_surface, hn::IfThenElse(leaves, fine_, hn::Neg(fine_)), f_);
    }
    const VD side = hn::IfThenElse(outside, number(1), number(-1));
    side_ = hn::IfThenElse(fresh_, side, side_);
    fresh_ = hn::FirstN(dd_, 0);
  }

  HWY_INLINE void keep(MD crossed, VD x, VD f, SdfRays::Row<std::int64_t>& found,
                       std::size_t& count) {
    alignas(64) std::array<double, doubles> a, b, f_a, f_b;
    hn::Store(s_, dd_, a.data()), hn::Store(x, dd_, b.data());
    hn::Store(f_, dd_, f_a.data()), hn::Store(f, dd_, f_b.data());
    std::array<std::uint8_t, 8> which{};
    hn::StoreMaskBits(dd_, crossed, which.data());
    for (unsigned left = which[0]; left != 0; left &= left - 1) {
      const auto k = static_cast<std::size_t>(std::countr_zero(left));
      const auto i = static_cast<std::size_t>(ray_[k]);
      rays_.a[i] = a[k], rays_.b[i] = b[k], rays_.f_a[i] = f_a[k], rays_.f_b[i] = f_b[k];
      found[count++] = ray_[k];
    }
  }

  static constexpr double most_slope = 0.5;
  const LaneSdf& sdf_;
  SdfRays& rays_;
  std::size_t next_ray_ = 0;
  alignas(64) std::array<std::int64_t, doubles> ray_;  ///< each lane's
  MD going_ = hn::FirstN(dd_, 0), fresh_ = hn::FirstN(dd_, 0);
  VD s_ = number(0), f_ = number(0), side_ = number(1), least_ = number(0), steps_ = number(0);
  VD end_ = number(0), fine_ = number(0);
  VD slope_ = number(-1);  ///< of F along the ray, a mean of the last steps'
  V3D o_{number(0), number(0), number(0)}, d_ = o_;
};

/// Fills SdfRays::s.
inline HWY_NOINLINE void trace(const LaneSdf& sdf, SdfRays& rays) {
  SdfRays::Row<std::int64_t> found;
  const std::size_t count = March(sdf, rays).run(found);
  for (std::size_t i = 0; i < count; i += doubles) {
    const VL ray = some_of([&](std::size_t k) { return found[k]; }, i, count);
    const Brackets bracket{rays.of(rays.a, ray), rays.of(rays.b, ray), rays.of(rays.f_a, ray),
                           rays.of(rays.f_b, ray)};
    alignas(64) std::array<double, doubles> s;
    hn::Store(narrowed(sdf, rays.origins(ray), rays.directions(ray), bracket), dd_, s.data());
    for (std::size_t k = 0; k < doubles && i + k < count; ++k)
      rays.s[static_cast<std::size_t>(found[i + k])] = s[k];
  }
}

/// Where rays of a register met sdfs: the points, rounded once, and the unit normals.
struct SdfPoints {
  alignas(64) std::array<float, lanes> px{}, py{}, pz{}, nx{}, ny{}, nz{};
};

/// `rays` met the sdf at SdfRays::s.
inline HWY_NOINLINE void points_of(const LaneSdf& sdf, const SdfRays& rays, SdfPoints& points) {
  for (std::size_t i = 0; i < rays.count; i += doubles) {
    const VL ray =
        some_of([](std::size_t k) { return static_cast<std::int64_t>(k); }, i, rays.count);
    const V3D p = at(rays.origins(ray), rays.directions(ray), rays.of(rays.s, ray));
    alignas(64) std::array<double, doubles> gx, gy, gz;
    const V3D gradient = evaluate<true>(sdf, p).gradient;
    hn::Store(gradient.x, dd_, gx.data());
    hn::Store(gradient.y, dd_, gy.data());
    hn::Store(gradient.z, dd_, gz.data());
    for (std::size_t k = 0; k < doubles && i + k < rays.count; ++k) {
      const std::size_t r = i + k, lane = rays.lane[r];
      const glm::dvec3 along(rays.dx[r], rays.dy[r], rays.dz[r]);
      const glm::dvec3 here = glm::dvec3(rays.ox[r], rays.oy[r], rays.oz[r]) + rays.s[r] * along;
      const glm::dvec3 slope(gx[k], gy[k], gz[k]);
      const double length = glm::length(slope);
      // Where two surfaces just touch there is no normal: let it face the ray.
      const glm::dvec3 out = length > 0 ? slope / length : -along;
      const glm::dvec3 n = sdf.place.rotation * (sdf.flipped ? -out : out);
      const glm::dvec3 world = sdf.place(here);
      points.px[lane] = static_cast<float>(world.x), points.py[lane] = static_cast<float>(world.y),
      points.pz[lane] = static_cast<float>(world.z);
      points.nx[lane] = static_cast<float>(n.x), points.ny[lane] = static_cast<float>(n.y),
      points.nz[lane] = static_cast<float>(n.z);
    }
  }
}

/// Vectors of a register, lane by lane.
struct Rows {
  alignas(64) std::array<float, lanes> x, y, z;
  HWY_INLINE explicit Rows(V3 v) {
    hn::Store(v.x, d_, x.data());
    hn::Store(v.y, d_, y.data());
    hn::Store(v.z, d_, z.data());
  }
  glm::vec3 operator[](std::size_t i) const { return {x[i], y[i], z[i]}; }
};

/// Those of the `wanted` rays o + t d, t up to `longest`, that may come near to the sdf.
HWY_INLINE M near_sdf(const LaneSdf& sdf, V3 o, V3 d, V longest, M wanted) {
  const auto f = [](double x) HWY_ATTR { return set(static_cast<float>(x)); };
  const glm::dmat3& r = sdf.place.rotation;
  const V inverse = f(1 / sdf.place.scale);
  const V3 from = inverse * (o - set(static_cast<float>(sdf.place.origin.x),
                                     static_cast<float>(sdf.place.origin.y),
                                     static_cast<float>(sdf.place.origin.z)));
  // What the coordinates' rounding may take, many times over.
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
  // Divisions by small numbers have lost a few digits of what is large.
  return hn::And(wanted, hn::Le(hn::Mul(begin, set(1 - 1e-5f)), hn::Mul(end, set(1 + 1e-5f))));
}

HWY_INLINE void rays_near(const LaneSdf& sdf, V3 o, V3 d, V longest, M wanted,
                          std::uint32_t first_lane, SdfRays& rays) {
  std::uint32_t left = bits(near_sdf(sdf, o, d, longest, wanted));
  if (left == 0) return;
  const Rows origins(o), directions(d);
  alignas(64) std::array<float, lanes> ends;
  hn::Store(longest, d_, ends.data());
  for (; left != 0; left &= left - 1) {
    const auto lane = static_cast<std::uint32_t>(std::countr_zero(left));
    rays.add(sdf, first_lane + lane, origins[lane], directions[lane], ends[lane]);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace renderer
HWY_AFTER_NAMESPACE();

#endif  // CARLO_SPHERE_TRACING_INL
