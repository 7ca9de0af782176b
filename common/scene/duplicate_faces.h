#pragma once

#include "scene/mesh_file.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace carlo {

/// A key of a point: equal for equal points. Sums of such are keys of their sets.
std::uint64_t key_of(Vec3 p);

using Triangle = std::array<Vec3, 3>;

/// Whether they have exactly the same corners, in an order that goes the same way around.
bool same_triangle(const Triangle& a, const Triangle& b);

/// Marks in `left_out`, by triangles, the faces of a mesh that stand there once more: with exactly
/// the same corners, the same way around. `positions` are those of the file's vertices, perhaps
/// after a transform. Returns how many faces; triangles that are marked already are not looked at.
/// A surface that stands there twice is met once by a ray, but would be two lamps.
std::size_t mark_duplicate_faces(const MeshFile& file, const std::vector<Vec3>& positions,
                                 std::vector<char>& left_out);

}  // namespace carlo
