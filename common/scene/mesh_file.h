#pragma once

#include "numeric/vec.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace carlo {

/// What a mesh file holds, in its own coordinates. Polygons are split into fans, so they must be
/// convex. Indices are all below positions.size().
struct MeshFile {
  std::vector<glm::dvec3> positions;
  std::vector<glm::uvec3> triangles;
  bool vertex_normals = false;     ///< the faces refer to vertex normals, which are not kept
  std::vector<std::string> notes;  ///< what else the file holds and is not used
};

/// Wavefront OBJ: v, f (also with /vt/vn and negative indices); vt, vn, o, g, s, mtllib and usemtl
/// are passed over; lines and points are left out with a note.
/// Throws Error "FILE:LINE: what is wrong".
MeshFile read_obj(const std::filesystem::path& path);

/// PLY 1.0, ascii or binary_little_endian: elements vertex (x, y, z) and face (vertex_indices or
/// vertex_index); further properties and elements are passed over with a note.
/// Throws Error "FILE: what is wrong".
MeshFile read_ply(const std::filesystem::path& path);

/// Adds a polygon as a fan of triangles about its first corner; three corners or more.
void add_polygon(MeshFile& mesh, const std::vector<std::uint32_t>& corners);

}  // namespace carlo
