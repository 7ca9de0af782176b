#pragma once

#include "scene/mesh_file.h"
#include "scene/scene.h"
#include "scene/xml_source.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace carlo {

/// A key of a point: equal for equal points. Sums of keys are keys of sets of points.
std::uint64_t key_of(Vec3 p);

using Triangle = std::array<Vec3, 3>;

/// True if they have exactly the same corners in the same cyclic order.
bool same_triangle(const Triangle& a, const Triangle& b);

/// Faces of a file that lie on others of it.
struct CoincidentFaces {
  std::size_t duplicates = 0;  ///< number of faces, now marked as left out
  /// Marks the triangles of polygons that lie on another one, facing the other way: triangles of
  /// such a pair need not coincide, for the diagonals may be others.
  std::vector<char> back_to_back;
};

/// Finds coincident faces of a mesh, those with exactly the same corners, and marks duplicates in
/// `left_out`, by triangles: faces that lie on an earlier one, facing the same way. `positions` are
/// those of the file's vertices, perhaps transformed; `turned` says which triangles will be turned
/// over. Ignores triangles that are left out already. A ray meets a duplicated surface once, but it
/// would be two lights.
CoincidentFaces find_coincident_faces(const MeshFile& file, const std::vector<Vec3>& positions,
                                      const std::vector<char>& turned, std::vector<char>& left_out);

/// Sets Mesh::back_to_back for triangles in the scene's meshes that lie on another one, facing the
/// other way, and clears it in meshes of glass, which a ray meets from both sides. Exporters of
/// two-sided surfaces write such pairs; which of the two a ray met was chance, and a light that is
/// met from behind is dark.
void mark_back_to_back(Scene& scene);

/// Leaves out lights that coincide with another light, up to the rounding of their corners, and
/// face the same way: parallelograms, spheres, disks, and triangles of meshes, which may be half of
/// a parallelogram. A ray meets only one of them, but both would give light. A note says how many.
/// Throws Error `at` if the two differ in radiance or material.
void leave_out_duplicate_lights(Scene& scene, Position at);

}  // namespace carlo
