// Intersects a register of rays with the scene's meshes. Included once for each instruction set.

#if defined(CARLO_MESH_HITS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef CARLO_MESH_HITS_INL
#undef CARLO_MESH_HITS_INL
#else
#define CARLO_MESH_HITS_INL
#endif

#include "geometry/mesh_tracer.h"
#include "renderer/lanes/intersect-inl.h"
#include "renderer/lanes/lane_scene.h"
#include "renderer/lanes/vector_math-inl.h"

#include <hwy/highway.h>

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

HWY_BEFORE_NAMESPACE();
namespace renderer {
namespace HWY_NAMESPACE {

static_assert(lanes <= carlo::MeshRays::most);

HWY_INLINE void store(V3 o, V3 d, V t, carlo::MeshRays& rays) {
  hn::Store(o.x, d_, rays.ox.data());
  hn::Store(o.y, d_, rays.oy.data());
  hn::Store(o.z, d_, rays.oz.data());
  hn::Store(d.x, d_, rays.dx.data());
  hn::Store(d.y, d_, rays.dy.data());
  hn::Store(d.z, d_, rays.dz.data());
  hn::Store(t, d_, rays.t.data());
}

/// Updates `hits` with nearer triangles, for the wanted rays o + t d.
inline HWY_NOINLINE void intersect_meshes(const LaneScene& s, const V3& o, const V3& d, M wanted,
                                          carlo::MeshRays& rays, Hits& hits) {
  store(o, d, hits.t, rays);
  const M met = mask_of(s.meshes->intersect(rays, bits(wanted)));
  keep_nearer(hits, met, hn::Load(d_, rays.t.data()),
              hn::Add(hn::Load(du_, rays.mesh.data()), set_word(s.first_mesh)));
}

/// One column per coordinate.
struct PointColumns {
  template <class T>
  using Column = std::array<T, lanes>;
  alignas(64) Column<float> px, py, pz, ex, ey, ez, nx, ny, nz, sx, sy, sz;

  void set(std::size_t i, const carlo::TrianglePoint& point) {
    px[i] = point.p.x, py[i] = point.p.y, pz[i] = point.p.z;
    ex[i] = point.error.x, ey[i] = point.error.y, ez[i] = point.error.z;
    nx[i] = point.n.x, ny[i] = point.n.y, nz[i] = point.n.z;
  }
  void set_shading(std::size_t i, carlo::Vec3 n) { sx[i] = n.x, sy[i] = n.y, sz[i] = n.z; }
  HWY_INLINE V3 at(const Column<float>& x, const Column<float>& y, const Column<float>& z) const {
    return {hn::Load(d_, x.data()), hn::Load(d_, y.data()), hn::Load(d_, z.data())};
  }
};

/// Points, normals, normals to shade with and rounding errors for the lanes whose surface is a
/// mesh.
inline HWY_NOINLINE void place_on_meshes(const LaneScene& s, const carlo::MeshRays& rays, M here,
                                         V3& p, V3& n, V3& ns, V3& error) {
  PointColumns points{};
  for (std::uint32_t left = bits(here); left != 0; left &= left - 1) {
    const auto i = static_cast<std::size_t>(std::countr_zero(left));
    const carlo::Mesh& mesh = s.meshes->mesh(rays.mesh[i]);
    const carlo::TrianglePoint point =
        carlo::triangle_point(mesh, rays.triangle[i], rays.u[i], rays.v[i]);
    points.set(i, point);
    if (s.smooth) {
      points.set_shading(i, carlo::shading_normal(mesh, rays.triangle[i], rays.u[i], rays.v[i],
                                                  point.n, {rays.dx[i], rays.dy[i], rays.dz[i]}));
    }
  }
  p = select(here, points.at(points.px, points.py, points.pz), p);
  n = select(here, points.at(points.nx, points.ny, points.nz), n);
  if (s.smooth) ns = select(here, points.at(points.sx, points.sy, points.sz), n);
  error = select(here, points.at(points.ex, points.ey, points.ez), error);
}

/// Removes the lanes whose segment from o to `to`, up to the given share of its length, is blocked
/// by a mesh.
inline HWY_NOINLINE void occlude_by_meshes(const LaneScene& s, const V3& o, const V3& to, V share,
                                           M& clear) {
  if (hn::AllFalse(d_, clear)) return;
  carlo::MeshRays rays;
  const V3 offset = to - o;
  const V distance = hn::Sqrt(dot(offset, offset));
  store(o, hn::Div(set(1), distance) * offset, hn::Mul(distance, share), rays);
  const M apart = hn::And(clear, hn::Gt(distance, set(0)));
  clear = hn::AndNot(mask_of(s.meshes->occluded(rays, bits(apart))), clear);
}

}  // namespace HWY_NAMESPACE
}  // namespace renderer
HWY_AFTER_NAMESPACE();

#endif  // CARLO_MESH_HITS_INL
