#include "scene/duplicates.h"
#include "scene/mesh_file.h"
#include "scene/shapes.h"
#include "scene/text.h"
#include "scene/transforms.h"
#include "support/error.h"

#include <fmt/format.h>
#include <glm/gtc/matrix_inverse.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <optional>
#include <utility>

namespace carlo {
namespace {

namespace fs = std::filesystem;

// Errors inside a mesh file are reported where the scene names it.
MeshFile read_mesh_file(const Properties& shape, const std::string& filename) {
  const Position at = shape.at("filename");
  const fs::path path = find_file(at, filename);
  std::error_code ec;
  if (!fs::exists(path, ec)) fail(at, "the mesh file {} does not exist", path_in_quotes(path));
  if (!fs::is_regular_file(path, ec)) fail(at, "{} is not a file", path_in_quotes(path));
  try {
    return shape.type() == "obj" ? read_obj(path) : read_ply(path);
  } catch (const Error& error) {
    fail_at(at, error.what());
  }
}

/// Drops the file's vertex normals if the scene says so.
void choose_normals(Properties& shape, MeshFile& file) {
  const auto face_normals = shape.boolean("faceNormals");
  if (face_normals == false && file.normals_of.empty()) {
    fail(shape.at("faceNormals"),
         "the mesh has no vertex normals, and none are computed: expected true");
  }
  if (face_normals == true) file.normals_of.clear();
}

/// The file's vertices and triangles without the harmful ones, and notes about what was left out.
class MeshBuilder {
 public:
  MeshBuilder(const MeshFile& file, std::vector<Vec3> positions, const glm::dmat4& to_world)
      : file_(file), left_out_(file.triangles.size()) {
    mesh_.positions = std::move(positions);
    if (!file.normals_of.empty()) take_normals(glm::inverseTranspose(glm::dmat3(to_world)));
  }

  /// `mirrored`: whether triangles are turned that have no vertex normals; `flipped`: all, after
  /// that.
  Mesh build(bool mirrored, bool flipped) {
    leave_out_degenerate();
    std::vector<char> turned_over(file_.triangles.size());
    for (std::size_t i = 0; i < file_.triangles.size(); ++i)
      turned_over[i] = is_turned(i, mirrored) != flipped ? 1 : 0;
    const auto [duplicates, back_to_back] =
        find_coincident_faces(file_, mesh_.positions, turned_over, left_out_);
    duplicates_ = duplicates;
    const bool any = std::find(back_to_back.begin(), back_to_back.end(), 1) != back_to_back.end();
    mesh_.triangles.reserve(file_.triangles.size());
    for (std::size_t i = 0; i < file_.triangles.size(); ++i) {
      if (left_out_[i] != 0) continue;
      const glm::uvec3 t = file_.triangles[i];
      const glm::uvec3 n = mesh_.normals.empty() ? glm::uvec3(Mesh::flat) : normals_of(i);
      flat_ += n.x == Mesh::flat ? 1 : 0;
      const bool turned = turned_over[i] != 0;
      const auto turn = [turned](glm::uvec3 c) { return turned ? glm::uvec3(c.x, c.z, c.y) : c; };
      mesh_.triangles.push_back(turn(t));
      if (!mesh_.normals.empty()) mesh_.normals_of.push_back(turn(n));
      if (any) mesh_.back_to_back.push_back(back_to_back[i]);
    }
    leave_out_unused();
    return std::move(mesh_);
  }

  /// Triangles without vertex normals.
  std::size_t flat() const { return flat_; }
  std::size_t degenerate() const { return degenerate_; }
  std::size_t duplicates() const { return duplicates_; }
  /// Triangles whose vertex normals have no direction.
  std::size_t without_direction() const { return without_direction_; }

 private:
  void take_normals(const glm::dmat3& to_world) {
    mesh_.normals.reserve(file_.normals.size());
    for (const glm::dvec3& n : file_.normals) {
      const glm::dvec3 there = to_world * n;
      const double length = glm::length(there);
      const bool has_direction = length > 0 && std::isfinite(length);
      mesh_.normals.push_back(has_direction ? Vec3(there / length) : Vec3(0));
    }
  }

  bool points_against(glm::uvec3 normals, glm::uvec3 corners) const {
    const auto at = [&](int k) { return glm::dvec3(mesh_.positions[corners[k]]); };
    const auto normal = [&](int k) { return glm::dvec3(mesh_.normals[normals[k]]); };
    const glm::dvec3 wound = glm::cross(at(1) - at(0), at(2) - at(0));
    return glm::dot(wound, normal(0) + normal(1) + normal(2)) < 0;
  }

  /// Whether its vertex normals, or where it has none its mirrored place, turn a triangle over.
  bool is_turned(std::size_t triangle, bool mirrored) const {
    if (mesh_.normals.empty() || !has_normals(triangle)) return mirrored;
    return points_against(file_.normals_of[triangle], file_.triangles[triangle]);
  }

  bool has_normals(std::size_t triangle) const {
    const glm::uvec3 t = file_.normals_of[triangle];
    if (t.x == MeshFile::no_normal) return false;
    const auto has_direction = [&](std::uint32_t n) { return mesh_.normals[n] != Vec3(0); };
    return has_direction(t.x) && has_direction(t.y) && has_direction(t.z);
  }

  glm::uvec3 normals_of(std::size_t triangle) {
    if (has_normals(triangle)) return file_.normals_of[triangle];
    without_direction_ += file_.normals_of[triangle].x == MeshFile::no_normal ? 0 : 1;
    return glm::uvec3(Mesh::flat);
  }

  void leave_out_degenerate() {
    for (std::size_t i = 0; i < file_.triangles.size(); ++i) {
      const glm::uvec3 t = file_.triangles[i];
      const Vec3 p = mesh_.positions[t.x];
      if (!is_degenerate(mesh_.positions[t.y] - p, mesh_.positions[t.z] - p)) continue;
      left_out_[i] = 1;
      ++degenerate_;
    }
  }

  /// Exporters leave unused vertices anywhere: they must not count for the scene's extent.
  void leave_out_unused() {
    constexpr auto unused = std::numeric_limits<std::uint32_t>::max();
    std::vector<std::uint32_t> places(mesh_.positions.size(), unused);
    for (const glm::uvec3& t : mesh_.triangles)
      places[t.x] = places[t.y] = places[t.z] = 0;
    std::uint32_t count = 0;
    for (std::size_t i = 0; i < places.size(); ++i) {
      if (places[i] == unused) continue;
      mesh_.positions[count] = mesh_.positions[i];
      places[i] = count++;
    }
    if (count == places.size()) return;
    mesh_.positions.resize(count);
    for (glm::uvec3& t : mesh_.triangles)
      t = {places[t.x], places[t.y], places[t.z]};
  }

  const MeshFile& file_;
  Mesh mesh_;
  std::vector<char> left_out_;  ///< of the file's triangles
  std::size_t flat_ = 0, degenerate_ = 0, duplicates_ = 0, without_direction_ = 0;
};

/// A note if the file's vertex normals suggest that its faces are wound the wrong way around.
std::optional<std::string> note_on_normals(const MeshFile& file, bool flipped) {
  if (file.faces_against == 0) return std::nullopt;
  const char* decides = file.normals_of.empty() ? "" : ", and decide which side is outside";
  if (file.faces_against < file.faces_with_normals) {
    return fmt::format("the vertex normals of {} of {} faces point against their triangles{}",
                       file.faces_against, file.faces_with_normals, decides);
  }
  if (flipped && file.normals_of.empty()) return std::nullopt;
  return fmt::format("the vertex normals of all {} faces point against their triangles{}",
                     file.faces_against, file.normals_of.empty() ? ": flipNormals?" : decides);
}

}  // namespace

Mesh parse_mesh(Properties& shape, std::vector<std::string>& notes) {
  const auto filename = shape.string("filename");
  if (!filename) shape.missing("filename", "string");
  const glm::dmat4 to_world = shape.to_world();
  const bool flipped = shape.boolean("flipNormals").value_or(false);
  MeshFile file = read_mesh_file(shape, *filename);
  choose_normals(shape, file);
  if (file.triangles.empty()) {
    fail(shape.at("filename"), "the mesh {} is empty: it has no faces{}", in_quotes(*filename),
         file.notes.empty() ? "" : fmt::format(" ({})", fmt::join(file.notes, "; ")));
  }

  std::vector<Vec3> positions;
  positions.reserve(file.positions.size());
  for (const glm::dvec3& p : file.positions)
    positions.push_back(transform_point(to_world, p, shape.at("toWorld")));
  MeshBuilder builder(file, std::move(positions), to_world);
  // A mirrored mesh keeps its outside in 0.6 files; Mitsuba 3 turns it inside out, as a sphere.
  const bool mirrored = mirrors(to_world), kept = shape.dialect() == Dialect::mitsuba06;
  Mesh mesh = builder.build(mirrored && kept, flipped);
  if (mesh.triangles.empty()) {
    fail(shape.at("filename"), "all {} triangles of {} are degenerate (no area)",
         builder.degenerate(), in_quotes(*filename));
  }
  notes.insert(notes.end(), file.notes.begin(), file.notes.end());
  if (builder.degenerate() > 0) {
    notes.push_back(
        fmt::format("{}: {} degenerate triangles left out", *filename, builder.degenerate()));
  }
  if (builder.duplicates() > 0)
    notes.push_back(
        fmt::format("{}: {} duplicate faces left out", *filename, builder.duplicates()));
  if (builder.without_direction() > 0) {
    notes.push_back(fmt::format("{}: {} triangles are flat: their vertex normals have no direction",
                                *filename, builder.without_direction()));
  }
  if (mirrored && builder.flat() > 0) {
    notes.push_back(fmt::format("{}: its toWorld mirrors it; {}", *filename,
                                kept
                                    ? "its outside stays outside, where Mitsuba turns it inside out"
                                    : "this turns it inside out, as in Mitsuba 3"));
  }
  if (const auto note = note_on_normals(file, flipped))
    notes.push_back(fmt::format("{}: {}", *filename, *note));
  return mesh;
}

}  // namespace carlo
