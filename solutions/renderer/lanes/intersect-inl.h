// Finds the nearest surfaces along rays, one ray per lane. Included once for each instruction set.

#if defined(CARLO_INTERSECT_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef CARLO_INTERSECT_INL
#undef CARLO_INTERSECT_INL
#else
#define CARLO_INTERSECT_INL
#endif

#include "renderer/lanes/flats-inl.h"
#include "renderer/lanes/lane_scene.h"
#include "renderer/lanes/rays-inl.h"
#include "renderer/lanes/tree-inl.h"
#include "renderer/lanes/vector_math-inl.h"

#include <hwy/highway.h>

#include <cstddef>
#include <cstdint>

HWY_BEFORE_NAMESPACE();
namespace renderer {
namespace HWY_NAMESPACE {

HWY_INLINE V3 axis_of(const LaneBox& box, std::size_t k) {
  return set(box.axis[k][0], box.axis[k][1], box.axis[k][2]);
}

/// Rays in the directions of a box's axes: the same for parallel boxes.
struct AlongAxes {
  V3 along, inverse;  ///< the components of d, and their reciprocals
  V3 o;               ///< the components of o, for an upright box
};
HWY_INLINE AlongAxes along_axes(const LaneBox& box, V3 o, V3 d) {
  // Replaces a component of 0 by 2^-63, so that 0 is never divided by 0; components from there to 2
  // have this bit set anyway.
  const auto component = [&](std::size_t k)
                             HWY_ATTR { return hn::Or(dot(axis_of(box, k), d), set(0x1p-63f)); };
  const V3 along{component(0), component(1), component(2)};
  AlongAxes axes{
      along, {hn::Div(set(1), along.x), hn::Div(set(1), along.y), hn::Div(set(1), along.z)}, o};
  if (box.upright)
    axes.o = {dot(axis_of(box, 0), o), dot(axis_of(box, 1), o), dot(axis_of(box, 2), o)};
  return axes;
}

/// Where a ray's line enters and leaves a box's slabs.
struct SlabHits {
  V3 enters, leaves;
};
HWY_INLINE SlabHits intersect_slabs(const LaneBox& box, V3 o, const AlongAxes& axes) {
  const auto from = [&](std::size_t k) HWY_ATTR {
    const V3 axis = axis_of(box, k);
    return mul_add(axis.x, o.x, mul_add(axis.y, o.y, mul_sub(axis.z, o.z, set(box.center[k]))));
  };
  // Both have the same bits where the axes are 1 and 0.
  const V3 from_center = box.upright ? axes.o - set(box.center[0], box.center[1], box.center[2])
                                     : V3{from(0), from(1), from(2)};
  const V3 middle = from_center * axes.inverse;
  const auto enters = [&](std::size_t k, V inverse, V at)
                          HWY_ATTR { return neg_mul_sub(set(box.half[k]), hn::Abs(inverse), at); };
  const auto leaves = [&](std::size_t k, V inverse, V at)
                          HWY_ATTR { return mul_sub(set(box.half[k]), hn::Abs(inverse), at); };
  return {{enters(0, axes.inverse.x, middle.x), enters(1, axes.inverse.y, middle.y),
           enters(2, axes.inverse.z, middle.z)},
          {leaves(0, axes.inverse.x, middle.x), leaves(1, axes.inverse.y, middle.y),
           leaves(2, axes.inverse.z, middle.z)}};
}

/// The number, within its box, of the side of slab k by which a ray enters (leaves).
HWY_INLINE U entered(std::size_t k, V along) {
  // The ray moves towards larger coordinates where `along` is positive, and enters by the lower
  // side.
  return hn::Or(hn::ShiftRight<31>(hn::BitCast(du_, along)),
                set_word(static_cast<std::uint32_t>(2 * k)));
}
HWY_INLINE U left(std::size_t k, V along) {
  return hn::Xor(hn::ShiftRight<31>(hn::BitCast(du_, along)),
                 set_word(static_cast<std::uint32_t>(2 * k + 1)));
}

/// The points where rays leave the enclosure. Those from surfaces start inside, even if their
/// origins are rounded; the camera's may miss it.
HWY_INLINE Hits leave_enclosure(const LaneScene& s, V3 o, V3 d, U last) {
  const AlongAxes axes = along_axes(s.enclosure, o, d);
  const SlabHits slabs = intersect_slabs(s.enclosure, o, axes);
  V leaves = slabs.leaves.x;
  U side = left(0, axes.along.x);
  const auto choose = [&](V t, U number) HWY_ATTR {
    side = hn::IfThenElse(hn::RebindMask(du_, hn::Lt(t, leaves)), number, side);
    leaves = hn::Min(t, leaves);
  };
  choose(slabs.leaves.y, left(1, axes.along.y));
  choose(slabs.leaves.z, left(2, axes.along.z));
  M met = hn::FirstN(d_, lanes);
  if (s.enclosure.faces != 0x3F) {
    const U faces = set_word(s.enclosure.faces);
    met = hn::RebindMask(d_, hn::Ne(hn::And(hn::Shr(faces, side), set_word(1)), set_word(0)));
  }
  if (!s.camera_inside) {
    const V enters = hn::Max(slabs.enters.x, hn::Max(slabs.enters.y, slabs.enters.z));
    const M misses = hn::Or(hn::Gt(enters, leaves), hn::Lt(leaves, set(0)));
    met = hn::AndNot(hn::And(misses, same(last, set_word(nothing))), met);
  }
  const auto first = static_cast<std::uint32_t>(s.solids.size()) * LaneScene::sides;
  return {
      select(met, hn::Max(leaves, set(0)), set(longest)),
      hn::IfThenElse(hn::RebindMask(du_, met), hn::Add(side, set_word(first)), set_word(nothing))};
}

/// The box that a surface is a side of.
HWY_INLINE U box_of(U surface) {
  static_assert(LaneScene::sides == 8);
  return hn::ShiftRight<3>(surface);
}

/// Calls f with the number of each solid and the rays along its axes, whose divisions are half of
/// the work.
template <class F>
HWY_INLINE void for_solids(const LaneScene& s, V3 o, V3 d, const F& f) {
  AlongAxes axes{d, d, o};
  for (std::uint32_t i = 0; i < s.solids.size(); ++i) {
    if (!s.solids[i].parallel) axes = along_axes(s.solids[i], o, d);
    f(i, axes);
  }
}

/// Seen from outside, where every path is, a solid lies ahead if the middle of the chord does. This
/// does not depend on the rounding of an origin that touches the solid.
HWY_INLINE void intersect_solid(const LaneScene& s, std::uint32_t i, V3 o, const AlongAxes& axes,
                                U last_box, Hits& hits) {
  const SlabHits slabs = intersect_slabs(s.solids[i], o, axes);
  V enters = slabs.enters.x;
  U side = entered(0, axes.along.x);
  const auto choose = [&](V t, U number) HWY_ATTR {
    side = hn::IfThenElse(hn::RebindMask(du_, hn::Gt(t, enters)), number, side);
    enters = hn::Max(t, enters);
  };
  choose(slabs.enters.y, entered(1, axes.along.y));
  choose(slabs.enters.z, entered(2, axes.along.z));
  const V leaves = hn::Min(slabs.leaves.x, hn::Min(slabs.leaves.y, slabs.leaves.z));
  const M ahead = hn::Gt(hn::Add(enters, leaves), set(0));
  const M nearer = hn::And(hn::And(hn::Le(enters, leaves), hn::Lt(enters, hits.t)),
                           hn::And(ahead, differs(last_box, set_word(i))));
  keep_nearer(hits, nearer, enters, hn::Add(side, set_word(i * LaneScene::sides)));
}

/// The intersection of a line and a sphere: t at the middle of the chord and at its ends.
struct Chord {
  V middle, enters, leaves;
  M met;
};
/// Source: Haines et al., "Precision improvements for ray/sphere intersection", Ray Tracing Gems,
/// chapter 7. d has length 1.
HWY_INLINE Chord intersect_sphere(const LaneScene& s, std::size_t i, V3 o, V3 d) {
  const V3 from_center = o - set(s.cx[i], s.cy[i], s.cz[i]);
  const V middle = hn::Neg(dot(from_center, d));
  const V3 closest = add_scaled(from_center, middle, d);
  const V half2 =
      neg_mul_add(closest.x, closest.x,
                  neg_mul_add(closest.y, closest.y,
                              neg_mul_add(closest.z, closest.z, set(s.radius[i] * s.radius[i]))));
  const M met = hn::Ge(half2, set(0));
  const V half = hn::Sqrt(hn::Max(half2, set(0)));
  return {middle, hn::Sub(middle, half), hn::Add(middle, half), met};
}

/// -1 where `arrival` (Origins) holds the opposite direction.
HWY_INLINE V turned(V3 arrival) {
  return select(hn::Gt(dot(arrival, arrival), set(2)), set(-1), set(1));
}

/// A ray from outside meets a sphere where it enters, one from inside where it leaves. A ray that
/// starts on the sphere meets it once more if it is inside, which is where the path came from, or
/// the opposite after passing through glass. It does so even if rounding puts a grazing ray's
/// origin outside, so that the line misses the sphere.
template <bool full>
HWY_INLINE void intersect_sphere(const LaneScene& s, std::uint32_t i, const Origins& from, V3 d,
                                 V of_origin, Hits& hits) {
  const U number = set_word(i);
  const Chord chord = intersect_sphere(s, std::size_t{i}, from.o, d);
  const M starts = same(from.last, number);
  const V outwards = dot(from.arrival, from.o - set(s.cx[i], s.cy[i], s.cz[i]));
  V from_inside = hn::Mul(turned(from.arrival), outwards);
  if constexpr (full) from_inside = select(from.through, hn::Neg(from_inside), from_inside);
  const M outside = hn::AndNot(starts, hn::Gt(chord.enters, set(0)));
  V t = select(outside, chord.enters, hn::Max(chord.leaves, set(0)));
  M ahead = hn::Gt(select(starts, from_inside, t), set(0));
  // The product of the origin's distances from the near and the far side of the sphere.
  const M touches =
      hn::AndNot(starts, hn::And(chord.met, within_rounding(hn::Mul(chord.enters, chord.leaves),
                                                            hn::Mul(of_origin, set(s.width[i])),
                                                            s.coordinates[i] * s.width[i])));
  if (HWY_UNLIKELY(!hn::AllFalse(d_, touches))) {
    const M was_outside = hn::Lt(outwards, set(0));
    t = select(touches, hn::Max(select(was_outside, chord.enters, chord.leaves), set(0)), t);
    ahead = select_mask(touches, hn::Or(hn::Gt(chord.middle, set(0)), hn::Not(was_outside)), ahead);
  }
  const M met = hn::Or(chord.met, hn::And(starts, hn::Gt(from_inside, set(0))));
  keep_nearer(hits, hn::And(hn::And(met, ahead), hn::Lt(t, hits.t)), t, number);
}

/// closest() for scenes with hierarchies; `wanted`: the lanes that have a ray.
inline HWY_NOINLINE void closest_in_trees(const LaneScene& s, const Origins& from, const V3& d,
                                          M wanted, Hits& hits) {
  const V of_origin = coordinates(from.o);
  const TreeSearch search(from.o, d, wanted);
  const auto far = [&]() HWY_ATTR { return hits.t; };
  const auto keep_for = [&](M rays, const Hits& found) HWY_ATTR {
    keep_nearer(hits, rays, found.t, found.surface);
    return true;
  };
  for_shapes_near(s.quad_tree, search, wanted, far, [&](std::uint32_t i, M rays) HWY_ATTR {
    Hits found = hits;
    intersect_flat<true, Outline::quad>(s, i, from, d, of_origin, found);
    return keep_for(rays, found);
  });
  for_shapes_near(s.disk_tree, search, wanted, far, [&](std::uint32_t i, M rays) HWY_ATTR {
    Hits found = hits;
    intersect_flat<true, Outline::disk>(s, i, from, d, of_origin, found);
    return keep_for(rays, found);
  });
  for_shapes_near(s.sphere_tree, search, wanted, far, [&](std::uint32_t i, M rays) HWY_ATTR {
    Hits found = hits;
    intersect_sphere<true>(s, i, from, d, of_origin, found);
    return keep_for(rays, found);
  });
}

/// The first surface along rays, without sdfs and meshes; d has length 1. Results are valid only
/// for the lanes of `wanted`. `members` calls those of a run that the rays may meet.
template <bool close, bool full, class Members = NearbyMembers>
HWY_INLINE Hits closest(const LaneScene& s, const Origins& from, V3 d, M wanted,
                        const Members& members = {}) {
  Hits hits{set(longest), set_word(nothing)};
  if (full && s.many) {
    closest_in_trees(s, from, d, wanted, hits);
    return hits;
  }
  if (s.enclosed) hits = leave_enclosure(s, from.o, d, from.last);
  V of_origin = set(0);
  if (close) of_origin = coordinates(from.o);
  for (std::uint32_t i = s.first_quad; i < s.first_disk; ++i) {
    const Run run = run_from(s, i);
    if (close && run.end > i + 1) {
      intersect_run(s, run, from, d, of_origin, members, hits);
      i = run.end - 1;
    } else {
      intersect_flat<close, Outline::quad>(s, i, from, d, of_origin, hits);
    }
  }
  if constexpr (full) {
    for (std::uint32_t i = s.first_disk; i < s.first_sphere; ++i)
      intersect_flat<close, Outline::disk>(s, i, from, d, of_origin, hits);
  }
  if constexpr (close) {
    for (std::uint32_t i = s.first_sphere; i < s.first_sdf; ++i)
      intersect_sphere<full>(s, i, from, d, of_origin, hits);
  }
  const U last_box = box_of(from.last);
  for_solids(s, from.o, d, [&](std::uint32_t i, const AlongAxes& axes) HWY_ATTR {
    intersect_solid(s, i, from.o, axes, last_box, hits);
  });
  return hits;
}

/// Both ends lie outside, so the solid is in the way if the middle of the chord lies between them.
HWY_INLINE M solid_occludes(const LaneBox& box, const Segments& segments, const AlongAxes& axes) {
  const SlabHits slabs = intersect_slabs(box, segments.from.o, axes);
  const V enters = hn::Max(slabs.enters.x, hn::Max(slabs.enters.y, slabs.enters.z)),
          leaves = hn::Min(slabs.leaves.x, hn::Min(slabs.leaves.y, slabs.leaves.z));
  const V twice_middle = hn::Add(enters, leaves);
  return hn::And(hn::Le(enters, leaves),
                 hn::And(hn::Gt(twice_middle, set(0)),
                         hn::Lt(twice_middle, hn::Add(segments.distance, segments.distance))));
}

/// Rounding has a larger effect than an end that touches the sphere. A light occludes its own
/// points only if they face inwards and the origin is outside.
template <bool full>
HWY_INLINE M sphere_occludes(const LaneScene& s, std::uint32_t i, const Segments& segments) {
  const Chord chord = intersect_sphere(s, std::size_t{i}, segments.from.o, segments.d);
  const V nearly = hn::Mul(segments.distance, set(1 - 1e-6f));  // for a light inside of the sphere
  const M starts = same(segments.from.last, set_word(i));
  const M outside = hn::AndNot(starts, hn::Gt(chord.enters, set(0)));
  M by_near = hn::And(
      outside, hn::Or(hn::Lt(chord.middle, segments.distance), hn::Lt(chord.enters, nearly)));
  const V outwards = dot(segments.from.arrival, segments.from.o - set(s.cx[i], s.cy[i], s.cz[i]));
  const V from_inside = hn::Mul(turned(segments.from.arrival), outwards);
  const M ahead = hn::Gt(select(starts, from_inside, chord.leaves), set(0));
  M by_far = hn::And(hn::AndNot(outside, ahead), hn::Lt(chord.leaves, nearly));
  if constexpr (full) {
    const M itself = same(segments.to_plane, set_word(i));
    by_far = hn::AndNot(itself, by_far);
    if (s.radius[i] > 0) by_near = hn::AndNot(itself, by_near);
  }
  const M met = hn::Or(chord.met, hn::And(starts, hn::Gt(from_inside, set(0))));
  return hn::And(met, hn::Or(by_near, by_far));
}

/// unoccluded() for scenes with hierarchies.
inline HWY_NOINLINE M unoccluded_by_trees(const LaneScene& s, const Segments& segments, M active) {
  M clear = active;
  const V of_origin = coordinates(segments.from.o);
  const TreeSearch search(segments.from.o, segments.d, active);
  const auto far = [&]() HWY_ATTR { return segments.distance; };
  const auto remove = [&](M occluded) HWY_ATTR {
    clear = hn::AndNot(occluded, clear);
    return !hn::AllFalse(d_, clear);
  };
  for_shapes_near(s.quad_tree, search, clear, far, [&](std::uint32_t i, M rays) HWY_ATTR {
    return remove(hn::And(rays, flat_occludes<true, Outline::quad>(s, i, segments, of_origin)));
  });
  for_shapes_near(s.disk_tree, search, clear, far, [&](std::uint32_t i, M rays) HWY_ATTR {
    return remove(hn::And(rays, flat_occludes<true, Outline::disk>(s, i, segments, of_origin)));
  });
  for_shapes_near(s.sphere_tree, search, clear, far, [&](std::uint32_t i, M rays) HWY_ATTR {
    return remove(hn::And(rays, sphere_occludes<true>(s, i, segments)));
  });
  return clear;
}

/// What a segment ends on.
enum class End { light, camera, surface };

/// The lanes of `active` whose segments reach their end unoccluded; sdfs and meshes are not tested.
template <bool close, bool full, End end = End::light>
HWY_INLINE M unoccluded(const LaneScene& s, const Segments& segments, M active) {
  if (full && s.many) return unoccluded_by_trees(s, segments, active);
  M clear = active;
  const U from_box = box_of(segments.from.last);
  for_solids(s, segments.from.o, segments.d, [&](std::uint32_t i, const AlongAxes& axes) HWY_ATTR {
    const M occluded =
        hn::And(solid_occludes(s.solids[i], segments, axes), differs(from_box, set_word(i)));
    clear = hn::AndNot(occluded, clear);
  });
  V of_origin = set(0);
  if (close) of_origin = coordinates(segments.from.o);
  for (std::uint32_t i = s.first_quad; i < s.first_disk; ++i) {
    if (end == End::light && s.lights == 1 && i == s.light_surface[0] &&
        !(full && s.other_lights()))
      continue;
    const Run run = run_from(s, i);
    if (close && run.end > i + 1) {
      clear = hn::AndNot(run_occludes(s, run, segments, clear, of_origin), clear);
      i = run.end - 1;
      continue;
    }
    clear = hn::AndNot(flat_occludes<close, Outline::quad>(s, i, segments, of_origin), clear);
  }
  if constexpr (full) {
    for (std::uint32_t i = s.first_disk; i < s.first_sphere; ++i)
      clear = hn::AndNot(flat_occludes<close, Outline::disk>(s, i, segments, of_origin), clear);
  }
  if constexpr (close) {
    for (std::uint32_t i = s.first_sphere; i < s.first_sdf; ++i)
      clear = hn::AndNot(sphere_occludes < full || end == End::surface > (s, i, segments), clear);
  }
  return clear;
}

}  // namespace HWY_NAMESPACE
}  // namespace renderer
HWY_AFTER_NAMESPACE();

#endif  // CARLO_INTERSECT_INL
