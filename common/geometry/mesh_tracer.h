#pragma once

#include "numeric/vec.h"
#include "scene/scene.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace carlo {

/// A point of a triangle, with a bound on the absolute rounding error of each coordinate, and the
/// triangle's unit normal.
struct TrianglePoint {
  Vec3 p, error, n;
};

/// The intersection of a ray and a triangle: o + t d, which is (1 - u - v) a + u b + v c.
struct TriangleHit {
  float t, u, v;
};

/// Computes the hit of a ray that, according to Embree, hits the triangle or nearly so: in double,
/// rounded once. Embree's own numbers depend on the processor's approximate reciprocals.
TriangleHit triangle_hit(const Mesh& mesh, std::uint32_t triangle, Vec3 o, Vec3 d,
                         const TriangleHit& about);

/// The point (1 - u - v) a + u b + v c of a triangle.
TrianglePoint triangle_point(const Mesh& mesh, std::uint32_t triangle, float u, float v);

/// The normal to shade with at that point, whose normal is n, for a ray in direction d:
/// interpolated from vertex normals and turned to n's side; n if there are none, or if they face
/// away from the ray.
Vec3 shading_normal(const Mesh& mesh, std::uint32_t triangle, float u, float v, Vec3 n, Vec3 d);

/// Several rays o + x d, 0 < x < t, one column per coordinate; and their hits: the mesh's number,
/// its triangle, and the point in it (triangle_point()). `t` becomes the distance.
struct MeshRays {
  static constexpr std::size_t most = 16;
  template <class T>
  using Column = std::array<T, most>;
  alignas(64) Column<float> ox, oy, oz, dx, dy, dz, t;
  alignas(64) Column<float> u, v;
  alignas(64) Column<std::uint32_t> mesh, triangle;
};

/// Answers ray queries against meshes alone, through Embree in its robust (watertight) mode.
/// Queries may come from any thread.
class MeshTracer {
 public:
  /// Keeps pointers to the meshes, which must outlive it. `embree`: settings as for
  /// rtcNewDevice(). Throws Error if Embree fails.
  explicit MeshTracer(std::vector<const Mesh*> meshes, const char* embree = nullptr);
  ~MeshTracer();
  MeshTracer(const MeshTracer&) = delete;
  MeshTracer& operator=(const MeshTracer&) = delete;

  const Mesh& mesh(std::size_t i) const { return *meshes_[i]; }

  /// Intersects the rays i with bit i of `wanted` set; returns those that hit a triangle. Other
  /// rays are not written. Fastest for rays that stay close to one another.
  std::uint32_t intersect(MeshRays& rays, std::uint32_t wanted) const;

  /// Returns those of the wanted rays with any hit.
  std::uint32_t occluded(const MeshRays& rays, std::uint32_t wanted) const;

 private:
  struct Impl;
  std::vector<const Mesh*> meshes_;
  std::unique_ptr<Impl> impl_;
};

}  // namespace carlo
