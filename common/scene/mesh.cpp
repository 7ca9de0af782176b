#include "cli/error.h"
#include "scene/mesh_file.h"
#include "scene/shapes.h"
#include "scene/text.h"
#include "scene/transforms.h"

#include <filesystem>

namespace carlo {
namespace {

namespace fs = std::filesystem;

// What is wrong inside a mesh file is reported where the scene names it, like all else.
MeshFile read_mesh_file(const Properties& shape, const std::string& filename) {
  const Position at = shape.at("filename");
  const fs::path path = at.source->path.parent_path() / filename;
  std::error_code ec;
  if (!fs::exists(path, ec)) fail(at, "the mesh file {} does not exist", path_in_quotes(path));
  if (!fs::is_regular_file(path, ec)) fail(at, "{} is not a file", path_in_quotes(path));
  try {
    return shape.type() == "obj" ? read_obj(path) : read_ply(path);
  } catch (const Error& error) {
    fail_at(at, error.what());
  }
}

void check_normals(Properties& shape, const MeshFile& file) {
  const auto face_normals = shape.boolean("faceNormals");
  if (face_normals == false) {
    fail(shape.at("faceNormals"), "smooth normals are not supported, expected true");
  }
  if (file.vertex_normals && !face_normals) {
    fail(shape.at("filename"),
         "the mesh has vertex normals, which are not supported; <boolean name=\"faceNormals\" "
         "value=\"true\"/> uses those of the triangles");
  }
}

}  // namespace

Mesh parse_mesh(Properties& shape, std::vector<std::string>& notes) {
  const auto filename = shape.string("filename");
  if (!filename) shape.missing("filename", "string");
  const glm::dmat4 to_world = shape.to_world();
  const bool turned = mirrors(to_world) != shape.boolean("flipNormals").value_or(false);
  const MeshFile file = read_mesh_file(shape, *filename);
  check_normals(shape, file);
  if (file.triangles.empty()) {
    fail(shape.at("filename"), "the mesh {} is empty: it has no faces", in_quotes(*filename));
  }

  Mesh mesh;
  mesh.positions.reserve(file.positions.size());
  for (const glm::dvec3& p : file.positions) {
    mesh.positions.push_back(transform_point(to_world, p, shape.at("toWorld")));
  }
  for (const glm::uvec3& t : file.triangles) {
    const Vec3 p = mesh.positions[t.x];
    if (is_degenerate(mesh.positions[t.y] - p, mesh.positions[t.z] - p)) continue;
    mesh.triangles.push_back(turned ? glm::uvec3(t.x, t.z, t.y) : t);
  }
  const std::size_t dropped = file.triangles.size() - mesh.triangles.size();
  if (mesh.triangles.empty()) {
    fail(shape.at("filename"), "all {} triangles of {} are degenerate (no area)", dropped,
         in_quotes(*filename));
  }
  notes.insert(notes.end(), file.notes.begin(), file.notes.end());
  if (dropped > 0) {
    notes.push_back(fmt::format("{}: {} degenerate triangles left out", *filename, dropped));
  }
  return mesh;
}

}  // namespace carlo
