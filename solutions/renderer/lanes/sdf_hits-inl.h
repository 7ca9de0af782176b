// Intersects a batch of rays with the scene's sdfs. Included once for each instruction set.

#if defined(CARLO_SDF_HITS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef CARLO_SDF_HITS_INL
#undef CARLO_SDF_HITS_INL
#else
#define CARLO_SDF_HITS_INL
#endif

#include "geometry/mesh_tracer.h"
#include "renderer/lanes/intersect-inl.h"
#include "renderer/lanes/lane_scene.h"
#include "renderer/lanes/sphere_tracing-inl.h"
#include "renderer/lanes/vector_math-inl.h"

#include <hwy/highway.h>

#include <array>
#include <cstddef>
#include <cstdint>

HWY_BEFORE_NAMESPACE();
namespace renderer {
namespace HWY_NAMESPACE {

/// A register's rays o + t d, for tests against sdfs.
struct RayRegister {
  V3 o, d;
  M wanted;
};

/// A register's segments from o to points of lights, none of which lies on an sdf.
struct ToLight {
  V3 o, to;
  V share;  ///< the part of the segment that a mesh may block: not its end, if the light is a mesh
  M clear;  ///< so far
};

/// The state of a register's paths at their next vertices.
struct Vertex {
  V2 u_light, u_lobe;
  Hits hits;
  M scattered;  ///< if there is a learner: lanes whose next direction was drawn by u_lobe,
  U side;       ///< and Guide::sides of their surfaces
  // For scenes with sdfs or meshes:
  RayRegister ray;
  std::array<double, lanes> t;  ///< hits on sdfs
  carlo::MeshRays of_mesh;      ///< hits on meshes
  V3 ns;                        ///< normals to shade with, if the scene is `smooth`
  V3 error;                     ///< of the point's coordinates
  ToLight to_light;             ///< segments to lights that nothing else blocks,
  V3 direct;                    ///< and their contributions
  V camera_root;                ///< of light paths: CameraMoment::root, if wanted
};

/// Sphere tracing, only where an sdf may be nearer than the hits so far.
inline HWY_NOINLINE void intersect_sdfs(const LaneScene& s, std::array<Vertex, batch>& vertices) {
  for (std::size_t k = 0; k < s.sdfs.size(); ++k) {
    SdfRays rays;
    for (std::size_t w = 0; w < batch; ++w) {
      const RayRegister& ray = vertices[w].ray;
      rays_near(s.sdfs[k], ray.o, ray.d, vertices[w].hits.t, ray.wanted, w * lanes, rays);
    }
    if (rays.count == 0) continue;
    trace(s.sdfs[k], rays);
    alignas(64) std::array<float, batch * lanes> t;
    t.fill(-1);
    for (std::size_t i = 0; i < rays.count; ++i) {
      if (!(rays.s[i] >= 0)) continue;
      const double far = rays.s[i] * rays.t_per_s[i];
      t[rays.lane[i]] = static_cast<float>(far);
      vertices[rays.lane[i] / lanes].t[rays.lane[i] % lanes] = far;
    }
    for (std::size_t w = 0; w < batch; ++w) {
      const V met = hn::Load(d_, t.data() + w * lanes);
      keep_nearer(vertices[w].hits, hn::Ge(met, set(0)), met,
                  set_word(s.first_sdf + static_cast<std::uint32_t>(k)));
    }
  }
}

/// Points and normals of the lanes whose surface is an sdf, in double until they are rounded once.
inline HWY_NOINLINE void place_on_sdfs(const LaneScene& s, const Vertex& vertex, const U& surface,
                                       V3& p, V3& n) {
  SdfPoints points{};
  M any = hn::FirstN(d_, 0);
  for (std::size_t k = 0; k < s.sdfs.size(); ++k) {
    const M here = same(surface, set_word(s.first_sdf + static_cast<std::uint32_t>(k)));
    if (hn::AllFalse(d_, here)) continue;
    any = hn::Or(any, here);
    SdfRays rays;
    rays.add(vertex.ray.o, vertex.ray.d, set(0), here, 0);
    rays.turn(s.sdfs[k]);
    for (std::size_t i = 0; i < rays.count; ++i)
      rays.s[i] = vertex.t[rays.lane[i]] / rays.t_per_s[i];
    points_of(s.sdfs[k], rays, points);
  }
  p = select(any,
             {hn::Load(d_, points.px.data()), hn::Load(d_, points.py.data()),
              hn::Load(d_, points.pz.data())},
             p);
  n = select(any,
             {hn::Load(d_, points.nx.data()), hn::Load(d_, points.ny.data()),
              hn::Load(d_, points.nz.data())},
             n);
}

/// carlo::offset_origin(): moves the point p of a surface off it, to the side of n, by as much as
/// its rounding error requires; for a path that arrived along d, |d| = 1, and stays on that side.
HWY_INLINE V3 off_surface(V3 p, V3 error, V3 n, V3 d) {
  const V3 size{hn::Abs(p.x), hn::Abs(p.y), hn::Abs(p.z)};
  const V3 back = add_scaled(p, hn::Mul(set(-2), hn::Sqrt(dot(error, error))), d);
  const V3 off = dot({hn::Abs(n.x), hn::Abs(n.y), hn::Abs(n.z)}, error) * n;
  // Rounding takes back no more than this.
  const auto moved = [](V x, V offset, V of_x) HWY_ATTR {
    return hn::Add(hn::Add(x, offset), hn::CopySign(hn::Mul(set(0x1p-23f), of_x), offset));
  };
  return {moved(back.x, off.x, size.x), moved(back.y, off.y, size.y), moved(back.z, off.z, size.z)};
}

/// Removes the lanes that an sdf blocks.
inline HWY_NOINLINE void occlude_by_sdfs(const LaneScene& s, std::array<Vertex, batch>& vertices) {
  const U of_lane = hn::Shl(set_word(1), hn::Iota(du_, 0));
  for (const LaneSdf& sdf : s.sdfs) {
    SdfRays rays;
    for (std::size_t w = 0; w < batch; ++w) {
      const ToLight& segment = vertices[w].to_light;
      const V3 to = segment.to - segment.o;
      const V distance = hn::Sqrt(dot(to, to));
      rays_near(sdf, segment.o, hn::Div(set(1), distance) * to, distance, segment.clear, w * lanes,
                rays);
    }
    if (rays.count == 0) continue;
    trace(sdf, rays);
    std::array<std::uint32_t, batch> blocked{};
    for (std::size_t i = 0; i < rays.count; ++i) {
      if (rays.s[i] >= 0) blocked[rays.lane[i] / lanes] |= std::uint32_t{1} << rays.lane[i] % lanes;
    }
    for (std::size_t w = 0; w < batch; ++w) {
      const M free = same(hn::And(of_lane, set_word(blocked[w])), set_word(0));
      M& clear = vertices[w].to_light.clear;
      clear = hn::And(clear, free);
    }
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace renderer
HWY_AFTER_NAMESPACE();

#endif  // CARLO_SDF_HITS_INL
