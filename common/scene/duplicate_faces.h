#pragma once

#include "scene/mesh_file.h"

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

/// Marks duplicate faces of a mesh in `left_out`, by triangles: faces with exactly the same corners
/// in the same cyclic order as an earlier one. `positions` are those of the file's vertices,
/// perhaps transformed. Returns the number of faces; ignores triangles that are marked already. A
/// ray meets a duplicated surface once, but it would be two lights.
std::size_t mark_duplicate_faces(const MeshFile& file, const std::vector<Vec3>& positions,
                                 std::vector<char>& left_out);

}  // namespace carlo
