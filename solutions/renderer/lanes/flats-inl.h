// Intersects rays with parallelograms and disks, one ray per lane. Included once for each
// instruction set.

#if defined(CARLO_FLATS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef CARLO_FLATS_INL
#undef CARLO_FLATS_INL
#else
#define CARLO_FLATS_INL
#endif

#include "renderer/lanes/lane_scene.h"
#include "renderer/lanes/rays-inl.h"
#include "renderer/lanes/vector_math-inl.h"

#include <hwy/highway.h>

#include <cstddef>
#include <cstdint>

HWY_BEFORE_NAMESPACE();
namespace renderer {
namespace HWY_NAMESPACE {

/// Two parallelograms that share an edge both reach a little across it, so that no ray aimed at the
/// edge slips through.
constexpr float reach = 1 + 4e-7f;

/// Tests whether a point of its plane lies in parallelogram or disk i.
enum class Outline { quad, disk };
template <Outline outline>
HWY_INLINE M inside(const LaneScene& s, std::size_t i, V3 p) {
  const V a = hn::Sub(dot(set(s.ax[i], s.ay[i], s.az[i]), p), set(s.a0[i]));
  const V b = hn::Sub(dot(set(s.bx[i], s.by[i], s.bz[i]), p), set(s.b0[i]));
  const V outwards =
      outline == Outline::disk ? mul_add(a, a, hn::Mul(b, b)) : hn::Max(hn::Abs(a), hn::Abs(b));
  return hn::Le(outwards, set(reach));
}

/// The intersection of a ray with the plane of parallelogram or disk i, and whether it is inside
/// the shape.
struct PlaneHit {
  V3 n;
  V below;  ///< how far the origin lies from the plane, in direction -n
  V along;  ///< the direction's component along n
  V t;
  M inside;
};
template <Outline outline>
HWY_INLINE PlaneHit intersect_plane(const LaneScene& s, std::size_t i, V3 o, V3 d) {
  const V3 n = set(s.nx[i], s.ny[i], s.nz[i]);
  const V below = hn::Sub(set(s.d[i]), dot(n, o)), along = dot(n, d);
  const V t = hn::Div(below, along);
  return {n, below, along, t, inside<outline>(s, i, add_scaled(o, t, d))};
}

/// True for rays that cross the plane which their origins touch; n is its normal. The coordinates
/// of an origin cannot tell on which side of the plane it lies, but it is the side from which the
/// path arrived.
HWY_INLINE M goes_through(V3 n, V along, V3 arrival) {
  return hn::Gt(hn::Mul(along, dot(n, arrival)), set(0));
}

template <bool close, Outline outline>
HWY_INLINE void intersect_flat(const LaneScene& s, std::uint32_t i, const Origins& from, V3 d,
                               V of_origin, Hits& hits) {
  const PlaneHit hit = intersect_plane<outline>(s, i, from.o, d);
  const M there = hn::And(hit.inside, differs(set_word(s.plane[i]), from.starts_on<close>()));
  V t = hit.t;
  M ahead = hn::Gt(t, set(0));
  if (close && s.touching) {
    const M touches = hn::And(there, within_rounding(hit.below, of_origin, s.coordinates[i]));
    if (HWY_UNLIKELY(!hn::AllFalse(d_, touches))) {
      ahead = select_mask(touches, goes_through(hit.n, hit.along, from.arrival), ahead);
      t = hn::IfThenZeroElse(touches, t);
    }
  }
  M nearer = hn::Lt(t, hits.t);
  // Among surfaces of one plane, whose distances are equal, the one that faces the ray wins.
  if (close && s.coplanar)
    nearer = hn::Or(nearer, hn::And(hn::Eq(t, hits.t), hn::Lt(hit.along, set(0))));
  keep_nearer(hits, hn::And(hn::And(nearer, ahead), there), t, set_word(i));
}

/// Parallelogram or disk i blocks a segment if the ends are on different sides of its plane. The
/// ends themselves are compared: the distance to a far light is too inaccurate to tell what is
/// close to it.
template <bool close, Outline outline>
HWY_INLINE M flat_occludes(const LaneScene& s, std::uint32_t i, const Segments& segments,
                           V of_origin) {
  const PlaneHit hit = intersect_plane<outline>(s, i, segments.from.o, segments.d);
  const U plane = set_word(s.plane[i]);
  const M there = hn::And(hit.inside, hn::And(differs(plane, segments.from.starts_on<close>()),
                                              differs(plane, segments.to_plane)));
  const V below_end = hn::Sub(set(s.d[i]), dot(hit.n, segments.to));
  M between = hn::Lt(hn::Mul(hit.below, below_end), set(0));
  if (close && s.touching) {
    const M touches = hn::And(there, within_rounding(hit.below, of_origin, s.coordinates[i]));
    if (HWY_UNLIKELY(!hn::AllFalse(d_, touches)))
      between =
          select_mask(touches, goes_through(hit.n, hit.along, segments.from.arrival), between);
  }
  return hn::And(there, between);
}

/// Parallelograms of one plane, with consecutive numbers, share everything but their outlines.
struct Run {
  std::uint32_t first, end;
};
HWY_INLINE Run run_from(const LaneScene& s, std::uint32_t i) {
  return {i, s.run_end[i]};
}
/// Calls f with the numbers of all parallelograms of those patches of a run that are near one of
/// the points p in the lanes of `active`; the points lie in its plane.
struct NearbyMembers {
  template <class F>
  HWY_INLINE void operator()(const LaneScene& s, const Run& run, V3 p, M active, const F& f) const {
    const std::uint32_t i = run.first;
    const V a = hn::Sub(dot(set(s.ax[i], s.ay[i], s.az[i]), p), set(s.a0[i]));
    const V b = hn::Sub(dot(set(s.bx[i], s.by[i], s.bz[i]), p), set(s.b0[i]));
    for (std::uint32_t k = i; k < run.end; k = s.patch_end[k]) {
      const M near =
          hn::And(hn::Le(hn::Abs(hn::Sub(a, set(s.patch_a[k]))), set(s.patch_half_a[k])),
                  hn::Le(hn::Abs(hn::Sub(b, set(s.patch_b[k]))), set(s.patch_half_b[k])));
      if (hn::AllFalse(d_, hn::And(near, active))) continue;
      for (std::uint32_t member = k; member < s.patch_end[k]; ++member)
        f(member);
    }
  }
};

/// intersect_flat() for those of a run that `members` calls, which is skipped if no ray meets its
/// plane.
template <class Members>
HWY_INLINE void intersect_run(const LaneScene& s, const Run& run, const Origins& from, V3 d,
                              V of_origin, const Members& members, Hits& hits) {
  const std::uint32_t i = run.first;
  const PlaneHit hit = intersect_plane<Outline::quad>(s, i, from.o, d);
  const M elsewhere = differs(set_word(s.plane[i]), from.plane);
  V t = hit.t;
  M ahead = hn::And(elsewhere, hn::Gt(t, set(0)));
  if (s.touching) {
    const M touches = hn::And(elsewhere, within_rounding(hit.below, of_origin, s.coordinates[i]));
    ahead = select_mask(touches, goes_through(hit.n, hit.along, from.arrival), ahead);
    t = hn::IfThenZeroElse(touches, t);
  }
  const M nearer = hn::And(ahead, hn::Lt(t, hits.t));
  const M level = hn::And(ahead, hn::Eq(t, hits.t));
  if (hn::AllFalse(d_, hn::Or(nearer, level))) return;
  const V3 p = add_scaled(from.o, hit.t, d);
  const M faced = hn::Lt(hit.along, set(0)), facing = hn::Gt(hit.along, set(0));
  // Among overlapping parallelograms the one that faces the ray wins.
  M open = nearer;
  members(s, run, p, hn::Or(nearer, level), [&](std::uint32_t k) HWY_ATTR {
    const M front = s.turned[k] != 0 ? facing : faced;
    const M taken = hn::And(inside<Outline::quad>(s, k, p),
                            hn::Or(open, hn::And(hn::Or(nearer, level), front)));
    keep_nearer(hits, taken, t, set_word(k));
    open = hn::AndNot(taken, open);
  });
}

/// flat_occludes() for any of a run.
HWY_INLINE M run_occludes(const LaneScene& s, const Run& run, const Segments& segments, M active,
                          V of_origin) {
  const std::uint32_t i = run.first;
  const U plane = set_word(s.plane[i]);
  const M there = hn::And(
      active, hn::And(differs(plane, segments.from.plane), differs(plane, segments.to_plane)));
  if (hn::AllFalse(d_, there)) return there;
  const PlaneHit hit = intersect_plane<Outline::quad>(s, i, segments.from.o, segments.d);
  const V below_end = hn::Sub(set(s.d[i]), dot(hit.n, segments.to));
  M between = hn::Lt(hn::Mul(hit.below, below_end), set(0));
  if (s.touching) {
    const M touches = within_rounding(hit.below, of_origin, s.coordinates[i]);
    between = select_mask(touches, goes_through(hit.n, hit.along, segments.from.arrival), between);
  }
  const M crosses = hn::And(there, between);
  M within = hn::FirstN(d_, 0);
  if (hn::AllFalse(d_, crosses)) return within;
  const V3 p = add_scaled(segments.from.o, hit.t, segments.d);
  NearbyMembers()(s, run, p, crosses, [&](std::uint32_t k) HWY_ATTR {
    within = hn::Or(within, inside<Outline::quad>(s, k, p));
  });
  return hn::And(crosses, within);
}

}  // namespace HWY_NAMESPACE
}  // namespace renderer
HWY_AFTER_NAMESPACE();

#endif  // CARLO_FLATS_INL
