#pragma once

#include "geometry/mesh_tracer.h"
#include "numeric/vec.h"
#include "scene/scene.h"

#include <cstddef>
#include <span>
#include <vector>

namespace renderer {

/// a_0, a_0 + a_1, ...
std::vector<double> running_sum(std::vector<double> values);

/// The element of a running sum that u, in [0, 1), falls into; u becomes its place within.
std::size_t pick(std::span<const double> sums, float& u);

/// A mesh that emits: points uniform over its area.
class MeshLight {
 public:
  /// Keeps a pointer to `mesh`.
  explicit MeshLight(const carlo::Mesh& mesh);

  double area() const { return areas_.back(); }

  /// The point, of density 1 / area(), that u in [0, 1)^2 is mapped to.
  carlo::TrianglePoint sample(carlo::Vec2 u) const;

 private:
  const carlo::Mesh* mesh_;
  std::vector<double> areas_;  ///< of the triangles, their running sum
};

}  // namespace renderer
