// Marches along rays until a signed distance function changes its sign. Included once for each
// instruction set.

#if defined(CARLO_MARCH_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef CARLO_MARCH_INL
#undef CARLO_MARCH_INL
#else
#define CARLO_MARCH_INL
#endif

#include "geometry/sphere_tracer.h"
#include "renderer/lanes/lane_sdf.h"
#include "renderer/lanes/sdf-inl.h"
#include "renderer/lanes/sdf_rays-inl.h"
#include "renderer/lanes/vector_math-inl.h"

#include <hwy/highway.h>

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

HWY_BEFORE_NAMESPACE();
namespace renderer {
namespace HWY_NAMESPACE {

/// As many floats as a register has doubles, for step lengths, which are reduced to allow for their
/// lower precision.
using DF = hn::Rebind<float, DD>;
using VF = hn::Vec<DF>;
using MF = hn::Mask<DF>;
constexpr DF df_;
HWY_INLINE VF in_float(float x) {
  return hn::Set(df_, x);
}
HWY_INLINE VF in_float(VD x) {
  return hn::DemoteTo(df_, x);
}
HWY_INLINE VD in_double(VF x) {
  return hn::PromoteTo(dd_, x);
}

/// A register of rays o + s d in progress. F counts as positive on the side of the surface that a
/// ray is on.
struct Marching {
  VL ray;           ///< among SdfRays
  MD going, fresh;  ///< fresh rays have not evaluated F yet
  V3D o, d;
  VD s, end, f;
  VD side;              ///< 1 outside, -1 inside
  VD fine;              ///< resolution()
  VD least, steps;      ///< the least step, and the number of steps since it was doubled
  VF slope;             ///< of F, a mean over the last steps; -1: unknown
  VF low, high;         ///< bounds of F' at s
  VF bend, reach;       ///< F'' >= -bend where F < reach, on this side of the surface and beyond it
  VF back, back_reach;  ///< F'' <= back where F > -back_reach

  /// Bounds of second derivatives, by the side that rays are on.
  HWY_INLINE void set_bends(const LaneSdf& sdf) {
    const MD outside = hn::Gt(side, number(0));
    const auto of = [&](double below, double above) HWY_ATTR {
      return in_float(hn::IfThenElse(outside, number(below), number(above)));
    };
    bend = of(sdf.below.most, sdf.above.most);
    reach = of(sdf.below.reach, sdf.above.reach);
    back = of(sdf.above.most, sdf.below.most);
    back_reach = of(sdf.above.reach, sdf.below.reach);
  }

  /// A distance h without a root: up to there F >= f + low h - bend h^2 / 2 > 0. Below 0 where no
  /// such bound holds.
  HWY_INLINE VF safe_step() const {
    const VF f_here = in_float(f), known = hn::Max(hn::Sub(f_here, in_float(fine)), in_float(0));
    const VF root = hn::Sqrt(hn::Add(hn::Mul(low, low), hn::Mul(hn::Add(bend, bend), known)));
    // The form of the quadratic's root that avoids a difference.
    const MF rising = hn::Ge(low, in_float(0));
    const VF length = hn::Div(hn::IfThenElse(rising, hn::Add(low, root), hn::Add(known, known)),
                              hn::IfThenElse(rising, bend, hn::Sub(root, low)));
    return hn::Min(hn::Mul(length, in_float(1 - 1e-5F)), hn::Sub(reach, f_here));
  }

  /// A distance h within which F has changed its sign exactly once: up to there F' <= high + back h
  /// < 0. 0 where that is not known.
  HWY_INLINE VF crossing_step() const {
    const VF at_most = in_float(hn::Add(f, fine)), square = hn::Mul(high, high);
    const VF rest = hn::Sub(square, hn::Mul(hn::Add(back, back), at_most));
    const VF length = hn::Div(hn::Mul(in_float(2 + 2e-4F), at_most),
                              hn::Sub(hn::Sqrt(hn::Max(rest, in_float(0))), high));
    const MF falls =
        hn::And(hn::Lt(high, in_float(0)), hn::Gt(rest, hn::Mul(in_float(0.01F), square)));
    return hn::IfThenElseZero(hn::And(falls, hn::Lt(hn::Sub(length, at_most), back_reach)), length);
  }

  /// Updates the bounds of F' at the end of a step from the values of F at both ends.
  HWY_INLINE void update_slopes(VD length, VD next, MD accepted) {
    const VF h = in_float(length), per_h = hn::Div(in_float(1), h);
    const VF rise = hn::Mul(in_float(hn::Sub(next, f)), per_h);
    const VF sum = in_float(hn::Add(next, f)),
             error = hn::Add(hn::Mul(in_float(fine), per_h), in_float(1e-6F));
    const auto changes = [h](VF of) HWY_ATTR { return hn::Mul(hn::Mul(in_float(0.5F), of), h); };
    // Along the step F is at most (f + next + h) / 2 and at least (f + next - h) / 2.
    const VF below = hn::Sub(rise, hn::Add(changes(bend), error));
    const VF above = hn::Add(rise, hn::Add(changes(back), error));
    const MF near = hn::Lt(hn::Add(sum, h), hn::Add(reach, reach));
    const MF near_back = hn::Gt(hn::Sub(sum, h), hn::Mul(in_float(-2), back_reach));
    const VF new_low = hn::IfThenElse(near, hn::Max(below, in_float(-1)), in_float(-1));
    const VF new_high = hn::IfThenElse(near_back, hn::Min(above, in_float(1)), in_float(1));
    const VF mean = hn::Add(hn::Mul(in_float(0.3F), rise), hn::Mul(in_float(0.7F), slope));
    const MF moved = hn::Gt(in_float(hn::IfThenElseZero(accepted, number(1))), in_float(0));
    low = hn::IfThenElse(moved, new_low, low);
    high = hn::IfThenElse(moved, new_high, high);
    slope = hn::IfThenElse(moved, hn::Min(mean, in_float(0.5F)), in_float(-1));
  }
};

/// SphereTracer::first_root() in lanes, until two values of F have different signs; bounds on F's
/// slope and curvature lengthen the steps. A lane whose ray has ended starts the next.
class March {
 public:
  HWY_INLINE March(const LaneSdf& sdf, SdfRays& rays) : sdf_(sdf), rays_(rays) {}

  /// Collects the rays for which F changes its sign and returns their number.
  HWY_INLINE std::size_t run(SdfRays::Row<std::int64_t>& found) {
    auto all = zeros<std::array<Marching, ways>>();
    std::size_t count = 0;
    for (;;) {
      bool any = false;
      for (Marching& m : all) {
        if (next_ray_ < rays_.count && 4 * hn::CountTrue(dd_, m.going) <= 3 * doubles) refill(m);
        any = any || !hn::AllFalse(dd_, m.going);
      }
      if (!any) {
        if (next_ray_ < rays_.count) continue;
        return count;
      }
      std::array<Stride, ways> strides;
      std::array<V3D, ways> p;
      for (std::size_t w = 0; w < ways; ++w) {
        strides[w] = stride(all[w]);
        p[w] = at(all[w].o, all[w].d, strides[w].to);
      }
      std::array<Jet, ways> f;
      evaluate<false>(sdf_, p, f);
      for (std::size_t w = 0; w < ways; ++w)
        count += step(all[w], strides[w], f[w].value, found.data() + count);
    }
  }

 private:
  static constexpr std::size_t ways = 2;

  struct Stride {
    VD to;
    MD certain;  ///< no root is missed, except two within a least step
  };

  /// The point at which to evaluate F next.
  HWY_INLINE Stride stride(const Marching& m) const {
    const VD across = in_double(m.crossing_step()), free = in_double(m.safe_step());
    const VD relaxed = hn::Mul(m.f, in_double(hn::Div(in_float(2), hn::Sub(in_float(1), m.slope))));
    const MD crosses = hn::Gt(across, number(0));
    const VD sure = hn::Max(hn::IfThenElse(crosses, across, free), m.least);
    const VD step = hn::IfThenElse(crosses, sure, hn::Max(relaxed, sure));
    const VD to = hn::Min(hn::Add(m.s, step), m.end);
    return {hn::IfThenElse(m.fresh, m.s, to), hn::Ge(sure, step)};
  }

  /// Advances by F's value there; returns the number of rays that crossed the surface.
  HWY_INLINE std::size_t step(Marching& m, const Stride& stride, VD value, std::int64_t* found) {
    const VD x = stride.to, length = hn::Sub(x, m.s), f = hn::Mul(value, m.side);
    const MD marching = hn::AndNot(m.fresh, m.going);
    // A step longer than the safe one is accepted if the balls around both ends leave no gap.
    const MD uncertain = hn::AndNot(stride.certain, hn::Gt(in_double(m.slope), number(-1)));
    const MD gap = hn::And(marching, hn::And(uncertain, hn::Gt(length, hn::Add(m.f, f))));
    const MD accepted = hn::AndNot(gap, marching);
    const MD crossed = hn::And(accepted, hn::Lt(f, number(0)));
    std::size_t crossings = 0;
    if (!hn::AllFalse(dd_, crossed)) crossings = keep(m, crossed, x, value, found);
    const MD over = hn::AndNot(hn::Lt(x, m.end), accepted);  // NaN ends the march, too
    m.going = hn::AndNot(hn::Or(crossed, over), m.going);
    m.update_slopes(length, f, accepted);
    m.s = hn::IfThenElse(accepted, x, m.s);
    m.f = hn::IfThenElse(accepted, f, m.f);
    if (!hn::AllFalse(dd_, m.fresh)) start(m, value);
    m.steps = hn::Add(m.steps, number(1));
    const MD slow = hn::Ge(m.steps, number(carlo::SphereTracer::steps_to_doubling));
    m.least = hn::IfThenElse(slow, hn::Add(m.least, m.least), m.least);
    m.steps = hn::IfThenZeroElse(slow, m.steps);
    return crossings;
  }

  /// Gives rays to the lanes that have none.
  HWY_INLINE void refill(Marching& m) {
    std::array<std::uint8_t, 8> bytes;
    hn::StoreMaskBits(dd_, m.going, bytes.data());
    const std::uint32_t free = ~std::uint32_t{bytes[0]} & ((1U << doubles) - 1);
    const VL shift = hn::ShiftLeft<2>(hn::Iota(dl_, 0));
    const VL rank =
        hn::And(hn::Shr(hn::Set(dl_, static_cast<std::int64_t>(bits_below[free])), shift),
                hn::Set(dl_, 15));
    const auto left = static_cast<std::int64_t>(rays_.count - next_ray_);
    const MD fresh = hn::AndNot(m.going, hn::RebindMask(dd_, hn::Gt(hn::Set(dl_, left), rank)));
    const VL next = hn::Add(hn::Set(dl_, static_cast<std::int64_t>(next_ray_)), rank);
    m.ray = hn::IfThenElse(hn::RebindMask(dl_, fresh), next, m.ray);
    next_ray_ += hn::CountTrue(dd_, fresh);
    m.o = rays_.origins(m.ray);
    m.d = rays_.directions(m.ray);
    m.end = rays_.of(rays_.end, m.ray);
    m.fine = rays_.of(rays_.fine, m.ray);
    const VD begin = rays_.of(rays_.begin, m.ray);
    const VD least =
        hn::Max(number(carlo::SphereTracer::least_step * sdf_.size), hn::Mul(number(4), m.fine));
    m.s = hn::IfThenElse(fresh, begin, m.s);
    m.least = hn::IfThenElse(fresh, least, m.least);
    m.steps = hn::IfThenZeroElse(fresh, m.steps);
    m.fresh = hn::And(fresh, hn::Lt(begin, m.end));
    m.going = hn::Or(m.going, m.fresh);
  }

  /// The side of the surface on which fresh rays start, by the value of F there. Rays that start on
  /// the surface count on the side that they head for; rays that start before the sdf's box are
  /// outside.
  HWY_INLINE void start(Marching& m, VD value) {
    const VD zero = number(0);
    const MD before = hn::Gt(m.s, zero);
    const MD on_surface = hn::And(m.fresh, hn::AndNot(before, hn::Le(hn::Abs(value), m.fine)));
    const MD near = hn::And(m.fresh, hn::Lt(hn::Abs(value), number(near_surface * sdf_.size)));
    MD outside = hn::Or(before, hn::Gt(value, zero));
    VD along = zero, f = hn::Abs(value);
    if (!hn::AllFalse(dd_, near)) {
      along = dot(evaluate<true>(sdf_, at(m.o, m.d, m.s)).gradient, m.d);
      outside = hn::Or(hn::And(on_surface, hn::Ge(along, zero)), hn::AndNot(on_surface, outside));
      f = hn::IfThenElse(on_surface, m.fine, f);
    }
    const VD side = hn::IfThenElse(outside, number(1), number(-1));
    m.side = hn::IfThenElse(m.fresh, side, m.side);
    m.f = hn::IfThenElse(m.fresh, f, m.f);
    m.set_bends(sdf_);
    // Far from the surface, slopes are not worth a gradient.
    along = hn::Mul(along, m.side);
    const auto bound = [&](double error, double none, VF known) HWY_ATTR {
      const VD slope = hn::IfThenElse(near, hn::Add(along, number(error)), number(none));
      return in_float(hn::IfThenElse(m.fresh, slope, in_double(known)));
    };
    m.low = bound(-1e-6, -1, m.low);
    m.high = bound(1e-6, 1, m.high);
    m.fresh = hn::FirstN(dd_, 0);
  }

  HWY_INLINE std::size_t keep(const Marching& m, MD crossed, VD x, VD f, std::int64_t* found) {
    alignas(64) std::array<double, doubles> a, b, f_a, f_b;
    alignas(64) std::array<std::int64_t, doubles> ray;
    hn::Store(m.s, dd_, a.data()), hn::Store(x, dd_, b.data());
    hn::Store(hn::Mul(m.f, m.side), dd_, f_a.data()), hn::Store(f, dd_, f_b.data());
    hn::Store(m.ray, dl_, ray.data());
    std::array<std::uint8_t, 8> which;
    hn::StoreMaskBits(dd_, crossed, which.data());
    std::size_t count = 0;
    for (unsigned left = which[0]; left != 0; left &= left - 1) {
      const auto k = static_cast<std::size_t>(std::countr_zero(left));
      const auto i = static_cast<std::size_t>(ray[k]);
      rays_.a[i] = a[k], rays_.b[i] = b[k], rays_.f_a[i] = f_a[k], rays_.f_b[i] = f_b[k];
      found[count++] = ray[k];
    }
    return count;
  }

  static constexpr double near_surface = 1e-3;  ///< in sizes of the sdf
  const LaneSdf& sdf_;
  SdfRays& rays_;
  std::size_t next_ray_ = 0;
};

}  // namespace HWY_NAMESPACE
}  // namespace renderer
HWY_AFTER_NAMESPACE();

#endif  // CARLO_MARCH_INL
