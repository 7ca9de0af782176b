#pragma once

#include "geometry/mesh_tracer.h"
#include "numeric/vec.h"
#include "renderer/light_tree.h"
#include "scene/scene.h"

#include <cstdint>
#include <vector>

namespace renderer {

double triangle_area(const carlo::Mesh& mesh, std::uint32_t triangle);

/// The bounds of a triangle that emits this radiance (R + G + B).
LightBounds triangle_bounds(const carlo::Mesh& mesh, std::uint32_t triangle, double radiance);

/// Maps u in [0, 1)^2 to a point of density 1 / area.
carlo::TrianglePoint sample_triangle(const carlo::Mesh& mesh, std::uint32_t triangle,
                                     carlo::Vec2 u);

/// A mesh that emits.
class MeshLight {
 public:
  /// Keeps a pointer to `mesh`.
  explicit MeshLight(const carlo::Mesh& mesh);

  double area() const { return areas_.back(); }

  struct Sample {
    carlo::TrianglePoint point;
    std::uint32_t triangle;
    double density;  ///< per area, > 0
  };
  /// Density 1 / area() everywhere.
  Sample sample(carlo::Vec2 u) const;

  /// A point of a triangle that is chosen by its possible contribution to the point p of a surface
  /// with normal n (LightTree); density 0 if none can contribute.
  Sample sample(carlo::Vec3 p, carlo::Vec3 n, carlo::Vec2 u) const;

  /// The density of that sample(), per area on the triangle.
  double density(carlo::Vec3 p, carlo::Vec3 n, std::uint32_t triangle) const;

  /// The bounds of the whole, with radiance 1.
  const LightBounds& bounds() const { return tree_.bounds(); }

 private:
  const carlo::Mesh* mesh_;
  std::vector<double> areas_;  ///< running sum of the triangles' areas
  LightTree tree_;
};

}  // namespace renderer
