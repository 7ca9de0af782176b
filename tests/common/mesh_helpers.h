#pragma once

#include "scene_helpers.h"
#include "support/error.h"

#include <string>
#include <variant>

namespace scene_test {

/// A scene with one <shape> of this type ("obj" or "ply") with this text, and these elements inside
/// the shape.
inline carlo::Scene load_mesh(const std::string& type, const std::string& bytes,
                              const std::string& inside = "") {
  const TemporaryFolder folder;
  write_bytes(folder.path() / ("mesh." + type), bytes);
  write_bytes(folder.path() / "scene.xml",
              "<scene version=\"0.6.0\"><sensor type=\"perspective\"><float name=\"fov\" "
              "value=\"45\"/></sensor><shape type=\"" +
                  type + "\"><string name=\"filename\" value=\"mesh." + type + "\"/>" + inside +
                  "</shape></scene>");
  return carlo::load_scene(folder.path() / "scene.xml");
}

inline carlo::Scene load_obj(const std::string& obj, const std::string& inside = "") {
  return load_mesh("obj", obj, inside);
}

inline const carlo::Mesh& mesh_of(const carlo::Scene& scene, std::size_t shape = 0) {
  return std::get<carlo::Mesh>(scene.shapes.at(shape).geometry);
}

/// The error when loading it; empty if it loads.
inline std::string mesh_error(const std::string& type, const std::string& bytes,
                              const std::string& inside = "") {
  try {
    load_mesh(type, bytes, inside);
  } catch (const carlo::Error& error) {
    return error.what();
  }
  return "";
}

/// The number of a scene's notes that contain a text.
inline int notes_with(const carlo::Scene& scene, const std::string& text) {
  int count = 0;
  for (const std::string& note : scene.notes)
    count += note.find(text) != std::string::npos ? 1 : 0;
  return count;
}

/// The vector area of a mesh, and the sum of its triangles' areas: of equal length if all of them
/// face the same way.
inline glm::dvec3 vector_area(const carlo::Mesh& mesh) {
  glm::dvec3 sum(0);
  for (const glm::uvec3& t : mesh.triangles) {
    const glm::dvec3 a(mesh.positions[t.x]), b(mesh.positions[t.y]), c(mesh.positions[t.z]);
    sum += glm::cross(b - a, c - a) / 2.0;
  }
  return sum;
}

inline double area(const carlo::Mesh& mesh) {
  double sum = 0;
  for (const glm::uvec3& t : mesh.triangles) {
    const glm::dvec3 a(mesh.positions[t.x]), b(mesh.positions[t.y]), c(mesh.positions[t.z]);
    sum += glm::length(glm::cross(b - a, c - a)) / 2.0;
  }
  return sum;
}

inline const std::string unit_square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";
inline const std::string face_normals = "<boolean name=\"faceNormals\" value=\"true\"/>";
inline const std::string flip_normals = "<boolean name=\"flipNormals\" value=\"true\"/>";

}  // namespace scene_test
