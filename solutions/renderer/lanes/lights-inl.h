// Light sampling, a lane a point. Included once for each instruction set.

#if defined(CARLO_LIGHTS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef CARLO_LIGHTS_INL
#undef CARLO_LIGHTS_INL
#else
#define CARLO_LIGHTS_INL
#endif

#include "renderer/lanes/lane_scene.h"
#include "renderer/lanes/lookup-inl.h"
#include "renderer/lanes/vector_math-inl.h"

#include <hwy/highway.h>

#include <cstdint>

HWY_BEFORE_NAMESPACE();
namespace renderer {
namespace HWY_NAMESPACE {

/// Points of lights, uniform over each one's area.
struct LightPoints {
  V3 p, n, Le;
  V area;  ///< one over the density per area, the light's choice included
  U plane;
};

HWY_INLINE V3 across(V3 corner, V2 u, V3 edge_u, V3 edge_v) {
  return add_scaled(add_scaled(corner, u.x, edge_u), u.y, edge_v);
}

HWY_INLINE LightPoints sample_only_light(const LaneScene& s, V2 u) {
  const std::uint32_t i = s.light_surface[0];
  return {across(set(s.lx[0], s.ly[0], s.lz[0]), u, set(s.lux[0], s.luy[0], s.luz[0]),
                 set(s.lvx[0], s.lvy[0], s.lvz[0])),
          set(s.nx[i], s.ny[i], s.nz[i]), set(s.le_r[i], s.le_g[i], s.le_b[i]),
          set(1 / s.light_density[i]), set_word(s.plane[i])};
}

HWY_INLINE LightPoints sample_light(const LaneScene& s, V2 u) {
  if (s.lights == 1) return sample_only_light(s, u);
  // The first light whose running sum is above u.x, which is stretched again.
  U index = set_word(0);
  V lower = set(0), upper = set(s.light_cdf[0]);
  for (std::uint32_t i = 1; i < s.lights; ++i) {
    const M beyond = hn::Ge(u.x, set(s.light_cdf[i - 1]));
    lower = select(beyond, set(s.light_cdf[i - 1]), lower);
    upper = select(beyond, set(s.light_cdf[i]), upper);
    index = hn::IfThenElse(hn::RebindMask(du_, beyond), set_word(i), index);
  }
  u.x = hn::Min(hn::Div(hn::Sub(u.x, lower), hn::Sub(upper, lower)), set(0x1.fffffep-1f));
  const Numbers light(index, s.lights);
  const U surface = light(s.light_surface.data());
  const Numbers at_surface(surface, s.surfaces);
  return {
      across(light(s.lx, s.ly, s.lz), u, light(s.lux, s.luy, s.luz), light(s.lvx, s.lvy, s.lvz)),
      at_surface(s.nx, s.ny, s.nz), at_surface(s.le_r, s.le_g, s.le_b),
      hn::Div(set(1), at_surface(s.light_density.data())),
      s.coplanar ? at_surface(s.plane.data()) : surface};
}

}  // namespace HWY_NAMESPACE
}  // namespace renderer
HWY_AFTER_NAMESPACE();

#endif  // CARLO_LIGHTS_INL
