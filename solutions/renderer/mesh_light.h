#pragma once

#include "geometry/mesh_tracer.h"
#include "numeric/vec.h"
#include "renderer/light_tree.h"
#include "scene/scene.h"

#include <cstdint>
#include <vector>

namespace renderer {

double triangle_area(const carlo::Mesh& mesh, std::uint32_t triangle);

/// A triangle that emits so much: radiance (R + G + B).
LightBounds triangle_bounds(const carlo::Mesh& mesh, std::uint32_t triangle, double radiance);

/// The point, of density 1 / area, that u in [0, 1)^2 is mapped to.
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
  /// Of density 1 / area() everywhere.
  Sample sample(carlo::Vec2 u) const;

  /// A point of a triangle that is chosen for what it brings to the point p of a surface with
  /// normal n (LightTree); of density 0 if none can bring anything.
  Sample sample(carlo::Vec3 p, carlo::Vec3 n, carlo::Vec2 u) const;

  /// Of that, per area on the triangle.
  double density(carlo::Vec3 p, carlo::Vec3 n, std::uint32_t triangle) const;

  /// Of radiance 1 in all.
  const LightBounds& bounds() const { return tree_.bounds(); }

 private:
  const carlo::Mesh* mesh_;
  std::vector<double> areas_;  ///< of the triangles, their running sum
  LightTree tree_;
};

}  // namespace renderer
