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

/// A face of more than three corners, and where it stands: the line of the file or, where it has no
/// lines, the face's number from 1.
struct Polygon {
  std::size_t first_triangle, first_corner, corners, place;
};

/// What a mesh file holds, in its own coordinates. Indices are all below positions.size().
struct MeshFile {
  std::vector<glm::dvec3> positions;
  std::vector<glm::uvec3> triangles;  ///< in the order of the faces; n - 2 for one of n corners
  std::vector<Polygon> polygons;      ///< those of the faces that have more than three corners
  std::vector<std::uint32_t> polygon_corners;
  bool vertex_normals = false;  ///< the faces refer to vertex normals, which are not kept
  std::size_t faces_with_normals = 0;
  std::size_t faces_against = 0;   ///< those whose vertex normals point to their other side
  std::vector<std::string> notes;  ///< what else the file holds and is not used
};

/// Wavefront OBJ: v, f (also with /vt/vn and negative indices), statements that go on after a \ at
/// the line's end. What changes no polygon is passed over: vt, o, g, s and mtllib without a word,
/// all else, lines and points with a note; what makes other geometry is an error.
/// Throws Error "FILE:LINE: what is wrong".
MeshFile read_obj(const std::filesystem::path& path);

/// PLY 1.0, ascii and binary: elements vertex (x, y, z), face and tristrips (vertex_indices or
/// vertex_index, in strips -1 begins another); further properties and elements are passed over with
/// a note.
/// Throws Error "FILE: what is wrong" or, where there are lines, "FILE:LINE: what is wrong".
MeshFile read_ply(const std::filesystem::path& path);

/// Adds a face of three corners or more; a polygon for the time being as a fan.
void add_face(MeshFile& mesh, std::span<const std::uint32_t> corners, std::size_t place);

/// Cuts those polygons anew that a fan does not fit (polygon.h), once all positions are known.
/// `place`: what numbers the places, such as ":" of lines. Throws Error
/// "NAME<place>12: what is wrong".
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
