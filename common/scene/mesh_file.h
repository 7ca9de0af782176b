#pragma once

#include "numeric/vec.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace carlo {

/// A face of more than three corners, and its place: the line of the file or, in files without
/// lines, the face's number from 1.
struct Polygon {
  std::size_t first_triangle, first_corner, corners, place;
};

/// The contents of a mesh file, in its own coordinates. Indices are all below positions.size().
struct MeshFile {
  std::vector<glm::dvec3> positions;
  std::vector<glm::uvec3> triangles;  ///< in the order of the faces; n - 2 for a face of n corners
  std::vector<Polygon> polygons;      ///< the faces with more than three corners
  std::vector<std::uint32_t> polygon_corners;
  /// Vertex normals, and those of each triangle's corners, x = no_normal for a face without; the
  /// latter is empty if no face has any.
  std::vector<glm::dvec3> normals;
  std::vector<glm::uvec3> normals_of;
  static constexpr std::uint32_t no_normal = 0xFFFFFFFF;
  std::size_t faces_with_normals = 0;
  std::size_t faces_against = 0;   ///< faces whose vertex normals point to the other side
  std::vector<std::string> notes;  ///< contents of the file that are not used
};

/// Reads Wavefront OBJ: v, f (also with /vt/vn and negative indices); a \ at the end of a line
/// continues a statement. Skips whatever changes no polygon: vt, o, g, s and mtllib silently,
/// everything else, lines and points with a note. Other geometry is an error. Throws Error
/// "FILE:LINE: what is wrong".
MeshFile read_obj(const std::filesystem::path& path);

/// Reads PLY 1.0, ascii and binary: elements vertex (x, y, z), face and tristrips (vertex_indices
/// or vertex_index; -1 begins another strip); skips further properties and elements with a note.
/// Throws Error "FILE: what is wrong" or, for files with lines, "FILE:LINE: what is wrong".
MeshFile read_ply(const std::filesystem::path& path);

/// Adds a face of at least three corners; a polygon provisionally as a fan. `normals`: one for each
/// corner, or none.
void add_face(MeshFile& mesh, std::span<const std::uint32_t> corners, std::size_t place,
              std::span<const std::uint32_t> normals = {});

/// Cuts polygons again that a fan does not fit, once all positions are known. `place`:
/// the separator before place numbers, such as ":" for lines. Throws Error "NAME<place>12: what is
/// wrong".
void cut_polygons(MeshFile& mesh, const std::string& name, std::string_view place);

/// Calls visit(corners, first triangle, number of triangles) for each face, in the file's order.
template <class Visit>
void for_each_face(const MeshFile& mesh, const Visit& visit) {
  std::size_t triangle = 0;
  const auto triangles_to = [&](std::size_t end) {
    for (; triangle < end; ++triangle)
      visit(std::span<const std::uint32_t>(&mesh.triangles[triangle].x, 3), triangle,
            std::size_t{1});
  };
  for (const Polygon& p : mesh.polygons) {
    triangles_to(p.first_triangle);
    visit(std::span(mesh.polygon_corners).subspan(p.first_corner, p.corners), triangle,
          p.corners - 2);
    triangle += p.corners - 2;
  }
  triangles_to(mesh.triangles.size());
}

}  // namespace carlo
