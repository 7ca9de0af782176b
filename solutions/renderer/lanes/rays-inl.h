// Rays, the surfaces that they meet, and bounds on rounding errors, one ray per lane. Included once
// for each instruction set.

#if defined(CARLO_RAYS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef CARLO_RAYS_INL
#undef CARLO_RAYS_INL
#else
#define CARLO_RAYS_INL
#endif

#include "numeric/robust.h"
#include "renderer/lanes/lane_scene.h"
#include "renderer/lanes/vector_math-inl.h"

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
HWY_INLINE M differs(U a, U b) {
  return hn::RebindMask(d_, hn::Ne(a, b));
}

/// The lanes with these bits().
HWY_INLINE M mask_of(std::uint32_t bits) {
  const U of_lane = hn::Shl(set_word(1), hn::Iota(du_, 0));
  return differs(hn::And(of_lane, set_word(bits)), set_word(0));
}

/// Origins of rays: on surfaces, or at the camera.
struct Origins {
  V3 o;
  V3 arrival;  ///< the direction in which the path arrived; 0 for the camera
  U last;      ///< the surface; `nothing` for the camera
  U plane;     ///< its plane (LaneScene::plane)
  M through;   ///< true if the ray was refracted through the surface
  V3 clear;    ///< o as moved by carlo::offset_origin(), for sdfs and meshes

  /// The plane that the ray starts on; unless the scene is `close`, planes are the surfaces' own.
  template <bool close>
  HWY_INLINE U starts_on() const {
    return close ? plane : last;
  }
};

/// The surface hit, and its distance.
struct Hits {
  V t;
  U surface;
};
HWY_INLINE void keep_nearer(Hits& hits, M nearer, V t, U surface) {
  hits.t = select(nearer, t, hits.t);
  hits.surface = hn::IfThenElse(hn::RebindMask(du_, nearer), surface, hits.surface);
}

/// The possible rounding error of an origin's distance from a surface is `rounding` times this sum
/// of coordinates and those of the surface (LaneScene::coordinates). It is local: distant surfaces
/// do not increase it here.
HWY_INLINE V coordinates(V3 o) {
  return hn::Add(hn::Abs(o.x), hn::Add(hn::Abs(o.y), hn::Abs(o.z)));
}
constexpr float rounding = carlo::rounding_bound(8);
HWY_INLINE V3 rounding_of(V3 p) {
  return set(rounding) * V3{hn::Abs(p.x), hn::Abs(p.y), hn::Abs(p.z)};
}
HWY_INLINE M within_rounding(V distance, V of_origin, float of_surface) {
  return hn::Le(hn::Abs(distance), hn::Mul(set(rounding), hn::Add(of_origin, set(of_surface))));
}

/// A segment between two surfaces: o + distance d, |d| = 1, is the point `to` of a light.
struct Segments {
  Origins from;
  V3 d, to;
  V distance;
  U to_plane;
};

}  // namespace HWY_NAMESPACE
}  // namespace renderer
HWY_AFTER_NAMESPACE();

#endif  // CARLO_RAYS_INL
