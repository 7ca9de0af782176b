// Mesh files: OBJ and both kinds of PLY.

#include "course/cli/source_folder.h"
#include "mesh_helpers.h"
#include "scene/duplicates.h"
#include "scene/mesh_file.h"
#include "scene/needs.h"

#include <fmt/format.h>

#include <algorithm>
#include <ctime>
#include <string>
#include <variant>

using namespace carlo;
using scene_test::load_obj;
using scene_test::mesh_of;

namespace {

const std::filesystem::path scenes = source_folder() / "tests/common/scenes";

/// The volume that the triangles enclose, positive for counter-clockwise ones seen from outside.
double volume(const Mesh& mesh) {
  double sum = 0;
  for (const glm::uvec3& t : mesh.triangles) {
    const glm::dvec3 a(mesh.positions[t.x]), b(mesh.positions[t.y]), c(mesh.positions[t.z]);
    sum += glm::dot(a, glm::cross(b, c)) / 6;
  }
  return sum;
}

}  // namespace

TEST_CASE("OBJ and both forms of PLY give the same tetrahedron, outside out", "[scene]") {
  const Scene scene = load_scene(scenes / "meshes.xml");
  REQUIRE(scene.shapes.size() == 3);
  for (std::size_t i = 0; i < 3; ++i) {
    const Mesh& mesh = mesh_of(scene, i);
    CHECK(mesh.positions.size() == 4);
    CHECK(mesh.triangles.size() == 4);
    CHECK(volume(mesh) == Catch::Approx(1.0 / 6));
  }
  const Needs n = needs(scene);
  CHECK(n.meshes == 3);
  CHECK(n.triangles == 12);
}

TEST_CASE("what a PLY file holds beyond the mesh is noted", "[scene]") {
  const MeshFile file = read_ply(scenes / "tetrahedron_binary.ply");
  REQUIRE(file.notes.size() == 3);
  CHECK(file.notes[0] == "tetrahedron_binary.ply: vertex's \"red\" is not used");
}

TEST_CASE("a polygon becomes a fan of triangles", "[scene]") {
  const Scene scene = load_obj(scene_test::unit_square + "f 1 2 3 4\n");
  REQUIRE(mesh_of(scene).triangles.size() == 2);
  CHECK(mesh_of(scene).triangles[0] == glm::uvec3(0, 1, 2));
  CHECK(mesh_of(scene).triangles[1] == glm::uvec3(0, 2, 3));
}

TEST_CASE("a mesh keeps its outside when it is mirrored, and turns it when flipped", "[scene]") {
  const std::string tetrahedron =
      "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
  const std::string mirror = "<transform name=\"toWorld\"><scale x=\"-2\"/></transform>";
  const std::string flip = "<boolean name=\"flipNormals\" value=\"true\"/>";
  CHECK(volume(mesh_of(load_obj(tetrahedron))) == Catch::Approx(1.0 / 6));
  CHECK(volume(mesh_of(load_obj(tetrahedron, mirror))) == Catch::Approx(2.0 / 6));
  CHECK(volume(mesh_of(load_obj(tetrahedron, flip))) == Catch::Approx(-1.0 / 6));
  CHECK(volume(mesh_of(load_obj(tetrahedron, flip + mirror))) == Catch::Approx(-2.0 / 6));
}

/// Checks that each corner's vertex normal is that of its position.
template <class Normal>
void check_normals(const carlo::Mesh& mesh, std::size_t triangles, const Normal& normal) {
  REQUIRE(mesh.triangles.size() == triangles);
  REQUIRE(mesh.normals_of.size() == triangles);
  for (std::size_t i = 0; i < triangles; ++i) {
    for (int k = 0; k < 3; ++k) {
      const glm::vec3 at = mesh.positions[mesh.triangles[i][k]];
      CHECK(glm::length(mesh.normals[mesh.normals_of[i][k]] - glm::normalize(normal(at))) < 1e-6f);
    }
  }
}

TEST_CASE("each corner keeps its vertex normal", "[scene]") {
  // An arrow, which no fan fits; normals are (x, y, 2) in a shuffled order, one of them twice.
  const std::string arrow =
      "v 0 0 0\nv 2 1 0\nv 0 2 0\nv 1 1 0\nv 2 -1 0\nvn 1 1 2\nvn 0 2 2\nvn 2 1 2\nvn 0 0 2\n"
      "vn 0 0 1\nvn 2 -1 2\nf 1//4 2//3 3//2 4//1\nf 1//5 2//-4 5//6\n";
  const auto there = [](glm::vec3 p) { return glm::vec3(p.x, p.y, 2); };
  check_normals(mesh_of(load_obj(arrow)), 3, there);
  // Normals are at right angles to what lies in the surface: x/3 where x is stretched by 3.
  const std::string stretched =
      "<transform name=\"toWorld\"><scale x=\"3\"/><translate z=\"5\"/></transform>";
  check_normals(mesh_of(load_obj(arrow, stretched)), 3,
                [](glm::vec3 p) { return glm::vec3(p.x / 9, p.y, 2); });
  check_normals(mesh_of(load_obj(arrow, scene_test::flip_normals)), 3, there);
  // Faces without, duplicates and degenerate ones between them.
  const Scene mixed = load_obj(arrow + "f 1 2 3\nf 1 2 3\nf 1//4 1//4 2//3\nf 2//3 3//2 1\n");
  const auto& mesh = mesh_of(mixed);
  REQUIRE(mesh.triangles.size() == 4);
  CHECK(mesh.normals_of[3].x == carlo::Mesh::flat);
  CHECK(mesh_of(load_obj(arrow, scene_test::face_normals)).normals_of.empty());
  const std::string strip =
      "ply\nformat ascii 1.0\nelement vertex 4\nproperty float nx\nproperty float ny\nproperty "
      "float nz\nproperty float x\nproperty float y\nproperty float z\nelement tristrips 1\n"
      "property list uchar int vertex_indices\nend_header\n0 0 4 0 0 0\n2 0 4 1 0 0\n"
      "0 2 4 0 1 0\n2 2 4 1 1 0\n4 0 1 2 3\n";
  check_normals(mesh_of(scene_test::load_mesh("ply", strip)), 2, there);
}

TEST_CASE("vertex normals decide which side is outside", "[scene]") {
  // As Mitsuba 3.9.1 renders it (findings/mitsuba_mirrored_sphere.sh).
  const auto up = [](const std::string& normal, const std::string& inside) {
    const Scene scene =
        load_obj(scene_test::unit_square + "vn " + normal + "\nf 1//1 2//1 3//1 4//1\n", inside);
    CHECK(scene_test::notes_with(scene, "mirrors") == 0);
    return scene_test::vector_area(mesh_of(scene)).z;
  };
  CHECK(up("0 0 1", "") == 1);
  CHECK(up("0 0 -1", "") == -1);
  CHECK(up("1 0 -0.1", "") == -1);
  CHECK(up("0 0 -1", scene_test::flip_normals) == 1);
  for (const char* z : {"1", "-1"}) {
    const std::string mirror =
        std::string("<transform name=\"toWorld\"><scale x=\"-1\" z=\"") + z + "\"/></transform>";
    CHECK(up("0 0 1", mirror) == (z[0] == '-' ? -1 : 1));
  }
  CHECK(scene_test::notes_with(
            load_obj(scene_test::unit_square + "vn 0 0 -1\nf 1//1 2//1 3//1\nf 1//1 3//1 4//1\n"),
            "of all 2 faces point against their triangles, and decide which side is outside") == 1);
}

TEST_CASE("duplicate faces are those that face the same way, as vertex normals have it",
          "[scene]") {
  const auto triangles = [](const std::string& faces, std::size_t back_to_back) {
    const Scene scene = load_obj(scene_test::unit_square + "vn 0 0 1\nvn 0 0 -1\n" + faces);
    const auto& marked = mesh_of(scene).back_to_back;
    CHECK(static_cast<std::size_t>(std::count(marked.begin(), marked.end(), 1)) == back_to_back);
    return mesh_of(scene).triangles.size();
  };
  const std::string up = "f 1//1 2//1 3//1 4//1\n", other_way_up = "f 4//1 3//1 2//1 1//1\n",
                    down = "f 1//2 2//2 3//2 4//2\n", half_down = "f 2//2 1//2 3//2\n";
  CHECK(triangles(up + other_way_up, 0) == 2);
  CHECK(triangles(up + down, 4) == 4);
  CHECK(triangles(up + half_down, 2) == 3);
  CHECK(triangles("f 1 2 3 4\nf 4 3 2 1\n", 4) == 4);  // with other diagonals
  CHECK(triangles("f 1 2 3 4\nf 2 3 4\n", 0) == 3);
}

TEST_CASE("triangles of several meshes lie back to back if any two do", "[scene]") {
  const carlo::Mesh up{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}};
  const carlo::Mesh down{{{0, 1, 0}, {1, 0, 0}, {0, 0, 0}}, {{0, 1, 2}}};
  const auto marked = [](const std::vector<carlo::Mesh>& meshes) {
    Scene scene;
    scene.materials = {{carlo::Diffuse{carlo::Rgb(0.5f)}, false}};
    for (const carlo::Mesh& mesh : meshes)
      scene.shapes.push_back({mesh});
    carlo::mark_back_to_back(scene);
    std::size_t count = 0;
    for (const carlo::Shape& shape : scene.shapes)
      count += std::get<carlo::Mesh>(shape.geometry).back_to_back.size();
    return count;
  };
  CHECK(marked({up, up}) == 0);
  CHECK(marked({up, down}) == 2);
  CHECK(marked({up, up, down}) == 3);
  CHECK(marked({up, down, down, up}) == 4);
}

TEST_CASE("vertex normals without a direction leave their triangles flat", "[scene]") {
  const Scene scene = load_obj(scene_test::unit_square +
                               "vn 0 0 0\nvn 0 0 2\nf 1//1 2//2 3//2\nf 1//2 3//2 4//2\n");
  const auto& mesh = mesh_of(scene);
  REQUIRE(mesh.normals_of.size() == 2);
  CHECK(mesh.normals_of[0].x == carlo::Mesh::flat);
  CHECK(mesh.normals[mesh.normals_of[1].x] == glm::vec3(0, 0, 1));
  CHECK(scene_test::notes_with(scene, "1 triangles are flat: their vertex normals have no dir") ==
        1);
}

TEST_CASE("faceNormals takes a mesh's vertex normals away", "[scene]") {
  const std::string smooth = scene_test::unit_square + "vn 0 0 1\nf 1//1 2//1 3//1\n";
  CHECK(mesh_of(load_obj(smooth)).normals_of.size() == 1);
  CHECK(mesh_of(load_obj(smooth, scene_test::face_normals)).normals_of.empty());
  CHECK_THROWS(load_obj(scene_test::unit_square + "f 1 2 3\n",
                        "<boolean name=\"faceNormals\" value=\"false\"/>"));
  // Texture coordinates alone are not normals, nor are missing numbers.
  for (const char* face : {"f 1/ 2/ 3/\n", "f 1// 2// 3//\n", "f 1/1/ 2/1/ 3/1/\n"})
    CHECK(mesh_of(load_obj(scene_test::unit_square + "vt 0 0\n" + face)).triangles.size() == 1);
  CHECK(mesh_of(load_obj(scene_test::unit_square + "vt 0 0\nf 1/1 2/1 3/1\n")).triangles.size() ==
        1);
}

TEST_CASE("normals that a file names and does not have are noted", "[scene]") {
  const Scene scene = load_obj(scene_test::unit_square + "f 1//1 2//2 3//9\n",
                               "<boolean name=\"faceNormals\" value=\"true\"/>");
  CHECK(mesh_of(scene).triangles.size() == 1);
  REQUIRE_FALSE(scene.notes.empty());
  CHECK(scene.notes[0] == "mesh.obj: 3 corners name normals that are not there");
}

TEST_CASE("degenerate triangles are left out with a note", "[scene]") {
  const Scene scene = load_obj(scene_test::unit_square + "f 1 2 3\nf 1 1 2\n");
  CHECK(mesh_of(scene).triangles.size() == 1);
  REQUIRE_FALSE(scene.notes.empty());
  CHECK(scene.notes[0] == "mesh.obj: 1 degenerate triangles left out");
}

TEST_CASE("comments, Windows line ends and stray lines do no harm", "[scene]") {
  const Scene scene = load_obj(
      "# c\r\nv 0 0 0 # origin\r\nv 1 0 0\r\nv 0 1 0 1\r\n\r\n"
      "usemtl red\r\nl 1 2\r\nf 1 2 3");
  CHECK(mesh_of(scene).triangles.size() == 1);
  REQUIRE(scene.notes.size() >= 2);
  CHECK(scene.notes[0] == "mesh.obj: materials named in the file are not used");
  CHECK(scene.notes[1] == "mesh.obj: 1 lines and points left out");
}

TEST_CASE("coordinates keep the precision that the file gives", "[scene]") {
  const Scene scene = load_obj("v 0.1 16777215 1e-30\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  CHECK(mesh_of(scene).positions[0] == Vec3(0.1f, 16777215.0f, 1e-30f));
}

TEST_CASE("a mesh that shines is one light a triangle", "[scene]") {
  const Needs n = needs(load_obj(scene_test::unit_square + "f 1 2 3 4\n",
                                 "<emitter type=\"area\"><rgb name=\"radiance\" value=\"2\"/>"
                                 "</emitter>"));
  CHECK(n.triangle_lights == 2);
  CHECK(n.area_lights() == 2);
}

TEST_CASE("a large mesh takes time in proportion to its size", "[scene]") {
  // Processor time for 16 times as many faces, on the same machine: about 16 times as much;
  // quadratic time would be 256 times. The same holds if each face is duplicated.
  const auto clock_ticks = [](std::size_t count) {
    std::string text, faces;
    for (std::size_t i = 0; i < count; ++i) {
      text += fmt::format("v {} {} 0\nv {} 0 0\nv {} 0 1\nf -1 -2 -3\n", i, 1 + i % 7, i + 1, i);
      faces += "f -1 -2 -3\n";
    }
    const std::clock_t start = std::clock();
    CHECK(mesh_of(load_obj(text)).triangles.size() == count);
    CHECK(mesh_of(load_obj(text + faces)).triangles.size() == count);
    return static_cast<double>(std::clock() - start);
  };
  const double few = std::min({clock_ticks(5'000), clock_ticks(5'000), clock_ticks(5'000)});
  CHECK(clock_ticks(80'000) < 80 * few);
}
