#pragma once

#include "numeric/vec.h"
#include "scene/scene.h"

#include <cstdint>
#include <memory>

namespace carlo {

/// The nearest intersection of a ray.
struct Hit {
  float t = 0;      ///< distance along the ray
  Vec3 p{0};        ///< the point, recomputed from the surface (more accurate than o + t d)
  Vec3 p_error{0};  ///< bound on the absolute rounding error of each coordinate of p
  Vec3 n{0};        ///< unit geometric normal, on the surface's own side, not the ray's
  /// The unit normal to shade with: n, or interpolated from a mesh's vertex normals. On n's side,
  /// and seen from the ray's side of the surface.
  Vec3 ns{0};
  std::uint32_t shape = 0;      ///< index into Scene::shapes
  std::uint32_t primitive = 0;  ///< triangle of a mesh
};

/// Answers ray queries against a scene's shapes through Embree, with triangles in its robust
/// (watertight) mode; parallelograms, spheres, disks and sdfs are intersected in double precision.
/// Queries may come from any thread.
class Intersector {
 public:
  /// Keeps a reference to `scene`, which must outlive it. Throws Error if Embree fails.
  explicit Intersector(const Scene& scene);
  ~Intersector();
  Intersector(const Intersector&) = delete;
  Intersector& operator=(const Intersector&) = delete;

  /// The nearest hit at t > 0; false if there is none.
  bool intersect(const Ray& ray, Hit& hit) const;

  static constexpr std::uint32_t nothing = 0xFFFFFFFF;

  /// True if anything lies at 0 < t < tmax, except for one shape, which must be a parallelogram, a
  /// sphere or a disk: the light that the ray aims at. Where a ray grazes a sphere, rounding could
  /// make it occlude itself. Nor do the other parallelograms of a parallelogram's plane: a light on
  /// its back, facing the other way, would by rounding hide every second point.
  bool occluded(const Ray& ray, float tmax, std::uint32_t but_for = nothing) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace carlo
