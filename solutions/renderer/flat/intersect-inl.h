// Which surface rays meet, a lane a ray. Included once for each instruction set.

#if defined(CARLO_INTERSECT_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef CARLO_INTERSECT_INL
#undef CARLO_INTERSECT_INL
#else
#define CARLO_INTERSECT_INL
#endif

#include "renderer/flat/flat_scene.h"
#include "renderer/flat/vector_math-inl.h"

#include <hwy/highway.h>

#include <cstdint>

HWY_BEFORE_NAMESPACE();
namespace renderer {
namespace HWY_NAMESPACE {

constexpr float longest = 1e30f;
constexpr std::uint32_t nothing = 0xFFFFFFFF;

HWY_INLINE M same(U a, U b) {
  return hn::RebindMask(d_, hn::Eq(a, b));
}
HWY_INLINE M other(U a, U b) {
  return hn::RebindMask(d_, hn::Ne(a, b));
}

/// A surface's number, and how far away it is.
struct Hits {
  V t;
  U surface;
};
HWY_INLINE void take(Hits& hits, M nearer, V t, U surface) {
  hits.t = select(nearer, t, hits.t);
  hits.surface = hn::IfThenElse(hn::RebindMask(du_, nearer), surface, hits.surface);
}

/// Across an edge that two parallelograms share, both reach a little further: rays that aim at the
/// edge pass between none.
constexpr float reach = 1 + 4e-7f;

/// Where a ray meets the plane of parallelogram i, and whether that is inside of it.
struct PlaneHit {
  V t;
  M inside;
};
HWY_INLINE PlaneHit meet_quad(const FlatScene& s, std::size_t i, V3 o, V3 d) {
  const V3 n = set(s.nx[i], s.ny[i], s.nz[i]);
  const V t = hn::Div(hn::Sub(set(s.d[i]), dot(n, o)), dot(n, d));
  const V3 p = add_scaled(o, t, d);
  const V a = hn::Sub(dot(set(s.ax[i], s.ay[i], s.az[i]), p), set(s.a0[i]));
  const V b = hn::Sub(dot(set(s.bx[i], s.by[i], s.bz[i]), p), set(s.b0[i]));
  return {t, hn::Le(hn::Max(hn::Abs(a), hn::Abs(b)), set(reach))};
}

/// Where the line of a ray enters and leaves one slab of a box.
struct SlabHit {
  V enters, leaves;
  V along;  ///< the direction's component along the slab's axis
};
HWY_INLINE SlabHit meet_slab(const FlatBox& box, std::size_t k, V3 o, V3 d) {
  const V3 axis = set(box.axis[k][0], box.axis[k][1], box.axis[k][2]);
  const V from =
      hn::MulAdd(axis.x, o.x, hn::MulAdd(axis.y, o.y, hn::MulSub(axis.z, o.z, set(box.center[k]))));
  // A component of 0 becomes 2^-63, so that 0 is never divided by 0; those from there to 2 have
  // this bit anyway.
  const V along = hn::Or(dot(axis, d), set(0x1p-63f));
  const V inverse = hn::Div(set(1), along), reach_of_half = hn::Abs(inverse);
  const V middle = hn::Mul(from, inverse);
  return {hn::NegMulSub(set(box.half[k]), reach_of_half, middle),
          hn::MulSub(set(box.half[k]), reach_of_half, middle), along};
}

/// The number, within its box, of the side of slab k that a ray enters (leaves) by.
HWY_INLINE U entered(std::size_t k, V along) {
  // It moves towards larger coordinates where `along` is positive, and enters by the lower side.
  return hn::Or(hn::ShiftRight<31>(hn::BitCast(du_, along)),
                set_word(static_cast<std::uint32_t>(2 * k)));
}
HWY_INLINE U left(std::size_t k, V along) {
  return hn::Xor(hn::ShiftRight<31>(hn::BitCast(du_, along)),
                 set_word(static_cast<std::uint32_t>(2 * k + 1)));
}

/// Where rays leave the enclosure. Those from surfaces start inside, even if their origins are
/// rounded; the camera's may miss it.
HWY_INLINE Hits leave_enclosure(const FlatScene& s, V3 o, V3 d, U last) {
  const SlabHit x = meet_slab(s.enclosure, 0, o, d), y = meet_slab(s.enclosure, 1, o, d),
                z = meet_slab(s.enclosure, 2, o, d);
  V leaves = x.leaves;
  U side = left(0, x.along);
  const auto choose = [&](V t, U number) HWY_ATTR {
    side = hn::IfThenElse(hn::RebindMask(du_, hn::Lt(t, leaves)), number, side);
    leaves = hn::Min(t, leaves);
  };
  choose(y.leaves, left(1, y.along));
  choose(z.leaves, left(2, z.along));
  M met = hn::FirstN(d_, lanes);
  if (s.enclosure.faces != 0x3F) {
    const U faces = set_word(s.enclosure.faces);
    met = hn::RebindMask(d_, hn::Ne(hn::And(hn::Shr(faces, side), set_word(1)), set_word(0)));
  }
  if (!s.camera_inside) {
    const V enters = hn::Max(x.enters, hn::Max(y.enters, z.enters));
    const M misses = hn::Or(hn::Gt(enters, leaves), hn::Lt(leaves, set(0)));
    met = hn::AndNot(hn::And(misses, same(last, set_word(nothing))), met);
  }
  const auto first = static_cast<std::uint32_t>(s.solids.size()) * FlatScene::sides;
  return {
      select(met, hn::Max(leaves, set(0)), set(longest)),
      hn::IfThenElse(hn::RebindMask(du_, met), hn::Add(side, set_word(first)), set_word(nothing))};
}

/// The box that a surface is a side of.
HWY_INLINE U box_of(U surface) {
  static_assert(FlatScene::sides == 8);
  return hn::ShiftRight<3>(surface);
}

HWY_INLINE void meet_solid(const FlatScene& s, std::uint32_t i, V3 o, V3 d, U last_box,
                           Hits& hits) {
  const SlabHit x = meet_slab(s.solids[i], 0, o, d), y = meet_slab(s.solids[i], 1, o, d),
                z = meet_slab(s.solids[i], 2, o, d);
  V enters = x.enters;
  U side = entered(0, x.along);
  const auto choose = [&](V t, U number) HWY_ATTR {
    side = hn::IfThenElse(hn::RebindMask(du_, hn::Gt(t, enters)), number, side);
    enters = hn::Max(t, enters);
  };
  choose(y.enters, entered(1, y.along));
  choose(z.enters, entered(2, z.along));
  const V leaves = hn::Min(x.leaves, hn::Min(y.leaves, z.leaves));
  const M nearer = hn::And(hn::And(hn::Le(enters, leaves), hn::Lt(enters, hits.t)),
                           hn::And(hn::Gt(enters, set(-s.slack)), other(last_box, set_word(i))));
  take(hits, nearer, enters, hn::Add(side, set_word(i * FlatScene::sides)));
}

/// Where a line meets a sphere: t of the middle of the chord, and half its length.
struct Chord {
  V middle, half;
  M met;
};
/// Source: Haines et al., "Precision improvements for ray/sphere intersection", Ray Tracing Gems,
/// chapter 7. d has length 1.
HWY_INLINE Chord meet_sphere(const FlatScene& s, std::size_t i, V3 o, V3 d) {
  const V3 from_center = o - set(s.cx[i], s.cy[i], s.cz[i]);
  const V middle = hn::Neg(dot(from_center, d));
  const V3 closest = add_scaled(from_center, middle, d);
  const V half2 = hn::NegMulAdd(
      closest.x, closest.x,
      hn::NegMulAdd(closest.y, closest.y,
                    hn::NegMulAdd(closest.z, closest.z, set(s.radius[i] * s.radius[i]))));
  const M met = hn::Ge(half2, set(0));
  return {middle, hn::Sqrt(hn::Max(half2, set(0))), met};
}

HWY_INLINE void meet_sphere(const FlatScene& s, std::uint32_t i, V3 o, V3 d, U last, Hits& hits) {
  const U number = set_word(i);
  const Chord chord = meet_sphere(s, std::size_t{i}, o, d);
  const V enters = hn::Sub(chord.middle, chord.half), leaves = hn::Add(chord.middle, chord.half);
  // A ray that starts on the sphere meets it once more if it goes inside: where it leaves.
  const M starts = same(last, number);
  const M outside = hn::AndNot(starts, hn::Gt(enters, set(-s.slack)));
  const V t = select(outside, enters, leaves);
  const M ahead = hn::Gt(t, select(starts, set(s.slack), set(-s.slack)));
  take(hits, hn::And(hn::And(chord.met, ahead), hn::Lt(t, hits.t)), t, number);
}

/// The first surface along rays that left the surface `last`; d has length 1.
template <bool spheres>
HWY_INLINE Hits closest(const FlatScene& s, V3 o, V3 d, U last) {
  Hits hits{set(longest), set_word(nothing)};
  if (s.enclosed) hits = leave_enclosure(s, o, d, last);
  const V first = set(-s.slack);
  for (std::uint32_t i = s.first_quad; i < s.first_sphere; ++i) {
    const PlaneHit hit = meet_quad(s, i, o, d);
    const M nearer = hn::And(hn::And(hn::Lt(hit.t, hits.t), hn::Gt(hit.t, first)),
                             hn::And(hit.inside, other(set_word(i), last)));
    take(hits, nearer, hit.t, set_word(i));
  }
  if constexpr (spheres) {
    for (std::uint32_t i = s.first_sphere; i < s.surfaces; ++i)
      meet_sphere(s, i, o, d, last, hits);
  }
  const U last_box = box_of(last);
  for (std::uint32_t i = 0; i < s.solids.size(); ++i)
    meet_solid(s, i, o, d, last_box, hits);
  return hits;
}

HWY_INLINE M solid_blocks(const FlatBox& box, V3 o, V3 d, V end) {
  const SlabHit x = meet_slab(box, 0, o, d), y = meet_slab(box, 1, o, d),
                z = meet_slab(box, 2, o, d);
  const V enters = hn::Max(x.enters, hn::Max(y.enters, z.enters)),
          leaves = hn::Min(x.leaves, hn::Min(y.leaves, z.leaves));
  return hn::And(hn::Le(enters, hn::Min(leaves, end)), hn::Gt(leaves, set(0)));
}

HWY_INLINE M sphere_blocks(const FlatScene& s, std::uint32_t i, V3 o, V3 d, V end, U from) {
  const Chord chord = meet_sphere(s, std::size_t{i}, o, d);
  const V enters = hn::Sub(chord.middle, chord.half), leaves = hn::Add(chord.middle, chord.half);
  const M starts = same(from, set_word(i));
  const M by_near = hn::AndNot(starts, hn::And(hn::Gt(enters, set(0)), hn::Lt(enters, end)));
  const M inside = hn::Or(starts, hn::Lt(enters, set(0)));
  const M by_far = hn::And(hn::And(inside, hn::Lt(leaves, end)),
                           hn::Gt(leaves, select(starts, set(s.slack), set(0))));
  return hn::And(chord.met, hn::Or(by_near, by_far));
}

/// Which of `asked` reach o + distance d, |d| = 1, without meeting anything but the surfaces
/// `from`, where they start, and `to`, where they end: both lie on the scene's surfaces.
template <bool spheres>
HWY_INLINE M unoccluded(const FlatScene& s, V3 o, V3 d, V distance, U from, U to, M asked) {
  const V end = hn::Mul(distance, set(1 - 1e-6f));
  M clear = asked;
  const U from_box = box_of(from);
  for (std::uint32_t i = 0; i < s.solids.size(); ++i) {
    const M blocks = hn::And(solid_blocks(s.solids[i], o, d, end), other(from_box, set_word(i)));
    clear = hn::AndNot(blocks, clear);
  }
  for (std::uint32_t i = s.first_quad; i < s.first_sphere; ++i) {
    if (s.lights == 1 && i == s.light_surface[0]) continue;
    const PlaneHit hit = meet_quad(s, i, o, d);
    const M meets = hn::And(hn::And(hn::Gt(hit.t, set(0)), hn::Lt(hit.t, end)), hit.inside);
    const U number = set_word(i);
    clear = hn::AndNot(hn::And(meets, hn::And(other(number, from), other(number, to))), clear);
  }
  if constexpr (spheres) {
    for (std::uint32_t i = s.first_sphere; i < s.surfaces; ++i)
      clear = hn::AndNot(sphere_blocks(s, i, o, d, end, from), clear);
  }
  return clear;
}

}  // namespace HWY_NAMESPACE
}  // namespace renderer
HWY_AFTER_NAMESPACE();

#endif  // CARLO_INTERSECT_INL
