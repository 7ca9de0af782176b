#include "scene/mesh_file.h"

#include "scene/polygon.h"
#include "support/error.h"

namespace carlo {

void add_face(MeshFile& mesh, std::span<const std::uint32_t> corners, std::size_t place) {
  if (corners.size() > 3) {
    mesh.polygons.push_back(
        {mesh.triangles.size(), mesh.polygon_corners.size(), corners.size(), place});
    mesh.polygon_corners.insert(mesh.polygon_corners.end(), corners.begin(), corners.end());
  }
  for (std::size_t i = 2; i < corners.size(); ++i)
    mesh.triangles.emplace_back(corners[0], corners[i - 1], corners[i]);
}

void cut_polygons(MeshFile& mesh, const std::string& name, std::string_view place) {
  std::vector<glm::dvec3> points;
  std::vector<glm::uvec3> triangles;
  for (const Polygon& polygon : mesh.polygons) {
    const std::uint32_t* const corners = &mesh.polygon_corners[polygon.first_corner];
    points.clear();
    for (std::size_t i = 0; i < polygon.corners; ++i)
      points.push_back(mesh.positions[corners[i]]);
    if (fan_fits(points)) continue;
    if (const auto wrong = cut_into_triangles(points, triangles))
      throw Error("{}{}{}: {}", name, place, polygon.place, *wrong);
    for (std::size_t i = 0; i < triangles.size(); ++i) {
      const glm::uvec3 t = triangles[i];
      mesh.triangles[polygon.first_triangle + i] = {corners[t.x], corners[t.y], corners[t.z]};
    }
  }
}

}  // namespace carlo
