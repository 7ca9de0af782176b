// How faces of real meshes are treated: duplicate faces, polygons that are not convex, unused
// vertices, vertex normals against the winding.

#include "mesh_helpers.h"
#include "scene/center.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

namespace {

using namespace carlo;
using namespace scene_test;

/// A face with these corners, from number `start` on, as a line of an OBJ file.
std::string face_from(const std::vector<int>& corners, std::size_t start) {
  std::string line = "f";
  for (std::size_t i = 0; i < corners.size(); ++i)
    line += fmt::format(" {}", corners[(start + i) % corners.size()]);
  return line + "\n";
}

TEST_CASE("a face that stands there more than once is taken once", "[scene]") {
  struct Case {
    std::string faces;
    std::size_t triangles;
    int duplicates;
  };
  const std::string again = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";
  const std::string minus = "v -0 0 -0\nv 1 -0 0\nv 1 1 -0\nv 0 1 0\n";
  const std::vector<Case> cases = {
      {"f 1 2 3 4\nf 1 2 3 4\n", 2, 1},
      {"f 1 2 3 4\nf 2 3 4 1\nf 3 4 1 2\nf 4 1 2 3\n", 2, 3},
      {"f 1 2 3\nf 2 3 1\nf 3 1 2\n", 1, 2},
      {again + "f 1 2 3 4\nf 6 7 8 5\n", 2, 1},
      {minus + "f 1 2 3\nf 5 6 7\n", 1, 1},
      {"f 1 2 3 4\nf 1 2 3\nf 1 3 4\n", 2, 2},
      {"f 1 2 3\nf 1 2 3 4\n", 2, 1},
      // In the opposite order, and with other corners.
      {"f 1 2 3 4\nf 4 3 2 1\n", 4, 0},
      {"f 1 2 3\nf 3 2 1\nf 2 1 3\n", 2, 1},
      {"f 1 2 3\nf 1 2 4\nf 2 3 4\n", 3, 0},
  };
  for (const Case& c : cases) {
    INFO(c.faces);
    const Scene scene = load_obj(unit_square + c.faces);
    CHECK(mesh_of(scene).triangles.size() == c.triangles);
    const std::string note = fmt::format("mesh.obj: {} duplicate faces left out", c.duplicates);
    CHECK(notes_with(scene, note) == (c.duplicates > 0 ? 1 : 0));
    CHECK(notes_with(scene, "duplicate") == (c.duplicates > 0 ? 1 : 0));
  }
}

TEST_CASE("faces are compared where the scene puts them", "[scene]") {
  // In float 1e8 and 1e8 + 1 are the same point.
  const std::string two =
      "v 0 0 0\nv 0 1 0\nv 0 0 1\nv 1 0 0\nv 1 1 0\nv 1 0 1\nf 1 2 3\nf 4 5 6\n";
  CHECK(mesh_of(load_obj(two)).triangles.size() == 2);
  const std::string thin = "<transform name=\"toWorld\"><scale x=\"1e-9\"/><translate x=\"1\"/>" +
                           std::string("</transform>");
  CHECK(mesh_of(load_obj(two, thin)).triangles.size() == 1);
}

TEST_CASE("a polygon is filled whatever corner it begins with", "[scene]") {
  struct Case {
    const char* name;
    std::string vertices;
    std::vector<int> corners;
    double area;
  };
  const std::string l = "v 0 0 0\nv 2 0 0\nv 2 1 0\nv 1 1 0\nv 1 2 0\nv 0 2 0\n";
  const std::vector<Case> cases = {
      {"L", l, {1, 2, 3, 4, 5, 6}, 3},
      {"L, clockwise", l, {6, 5, 4, 3, 2, 1}, 3},
      {"dart", "v 0 0 0\nv 2 1 0\nv 0 2 0\nv 1 1 0\n", {1, 2, 3, 4}, 1},
      {"U",
       "v 0 0 0\nv 3 0 0\nv 3 3 0\nv 2 3 0\nv 2 1 0\nv 1 1 0\nv 1 3 0\nv 0 3 0\n",
       {1, 2, 3, 4, 5, 6, 7, 8},
       7},
      {"L with corners on its edges",
       l + "v 1 0 0\nv 0 1 0\nv 2 .5 0\n",
       {1, 7, 2, 9, 3, 4, 5, 6, 8},
       3},
      {"square with a hole, by a cut",
       "v 0 0 0\nv 4 0 0\nv 4 4 0\nv 0 4 0\nv 1 1 0\nv 1 3 0\nv 3 3 0\nv 3 1 0\n",
       {1, 2, 3, 4, 1, 5, 6, 7, 8, 5},
       12},
      {"square in many",
       "v 0 0 0\nv 1 0 0\nv 2 0 0\nv 2 2 0\nv 1 2 0\nv 0 2 0\n",
       {1, 2, 3, 4, 5, 6},
       4},
      {"a corner twice", unit_square, {1, 2, 2, 3, 4}, 1},
  };
  const std::string turned =
      "<transform name=\"toWorld\"><rotate x=\"1\" y=\"2\" z=\"3\" "
      "angle=\"70\"/></transform>";
  for (const Case& c : cases) {
    for (std::size_t start = 0; start < c.corners.size(); ++start) {
      for (const std::string& place : {std::string(), turned}) {
        INFO(c.name << " from corner " << start);
        const Scene scene = load_obj(c.vertices + face_from(c.corners, start), place);
        const Mesh& mesh = mesh_of(scene);
        CHECK(area(mesh) == Catch::Approx(c.area));
        CHECK(glm::length(vector_area(mesh)) == Catch::Approx(c.area));
      }
    }
  }
}

TEST_CASE("polygons in PLY files are filled too, whichever element comes first", "[scene]") {
  const std::string vertices = "0 0 0\n2 0 0\n2 1 0\n1 1 0\n1 2 0\n0 2 0\n";
  const std::string vertex =
      "element vertex 6\nproperty float x\nproperty float y\nproperty float z\n";
  const std::string face = "element face 1\nproperty list uchar int vertex_indices\n";
  const std::string head = "ply\nformat ascii 1.0\n", end = "end_header\n";
  const std::string corners = "6 4 5 0 1 2 3\n";
  for (const std::string& text :
       {fmt::format("{}{}{}{}{}{}", head, vertex, face, end, vertices, corners),
        fmt::format("{}{}{}{}{}{}", head, face, vertex, end, corners, vertices)}) {
    const Scene scene = load_mesh("ply", text);
    CHECK(area(mesh_of(scene)) == Catch::Approx(3));
    CHECK(vector_area(mesh_of(scene)).z == Catch::Approx(3));
  }
  const std::string crossed = head + vertex + face + end + vertices + "4 0 2 1 5\n";
  CHECK(mesh_error("ply", crossed).find("mesh.ply:16: the edges of a face of 4 corners cross") !=
        std::string::npos);
}

TEST_CASE("a polygon whose edges cross is refused by its line", "[scene]") {
  const auto error_of = [](const std::string& obj) { return mesh_error("obj", obj); };
  const auto has = [](const std::string& text, const std::string& phrase) {
    INFO(text);
    CHECK(text.find(phrase) != std::string::npos);
  };
  const std::string bow_tie = "v 0 0 0\nv 1 1 0\nv 1 0 0\nv 0 1 0\nf 1 2 3 4\n";
  has(error_of(bow_tie), "mesh.obj:5: the edges of a face of 4 corners cross");
  std::string star;
  for (int i = 0; i < 5; ++i)
    star += fmt::format("v {} {} 0\n", std::cos(i * 2.513), std::sin(i * 2.513));
  has(error_of(star + "f 1 2 3 4 5\n"), "mesh.obj:6: the edges of a face of 5 corners cross");
  std::string loop;  // once around, and once more inside
  for (int i = 0; i < 12; ++i) {
    const double r = i < 6 ? 2 : 1, angle = i * 1.0472;
    loop += fmt::format("v {} {} 0\n", r * std::cos(angle), r * std::sin(angle));
  }
  has(error_of(loop + "f 1 2 3 4 5 6 7 8 9 10 11 12\n"), "corners cross");
}

TEST_CASE("a polygon of no width is no error, however its corners are rounded", "[scene]") {
  const Scene scene = load_obj("v 0 0 0\nv 1 1e-9 0\nv 2 -1e-9 0\nv 3 1e-9 0\nv 4 0 0\n" +
                               std::string("v 0 1 0\nf 1 2 3 4 5\nf 1 5 6\n"));
  CHECK(area(mesh_of(scene)) == Catch::Approx(2));
}

TEST_CASE("a polygon of many corners is filled, or refused when it would take minutes", "[scene]") {
  const auto gear = [](int corners, double inner) {
    std::string vertices, face = "f";
    for (int i = 0; i < corners; ++i) {
      const double r = i % 2 == 0 ? 1 : inner, angle = 2 * 3.14159265358979 * i / corners;
      vertices += fmt::format("v {} {} 0\n", r * std::cos(angle), r * std::sin(angle));
      face += fmt::format(" {}", i + 1);
    }
    return vertices + face + "\n";
  };
  CHECK(area(mesh_of(load_obj(gear(100'000, 1)))) == Catch::Approx(3.14159265).epsilon(1e-5));
  const Scene scene = load_obj(gear(2000, .5));
  // Each tooth's two sides and the centre: r R sin(2 pi / n) / 2.
  CHECK(area(mesh_of(scene)) == Catch::Approx(2000 * .25 * std::sin(2 * 3.14159265358979 / 2000)));
  CHECK(mesh_error("obj", gear(20'000, .5)).find("a face of 20000 corners that is not convex") !=
        std::string::npos);
}

TEST_CASE("vertices that no face uses are left out, and the scene is no larger for them",
          "[scene]") {
  const Scene with = load_obj("v 1e9 1e9 1e9\n" + unit_square + "v -7 0 0\nf 2 3 4 5\n");
  CHECK(mesh_of(with).positions.size() == 4);
  CHECK(area(mesh_of(with)) == 1);
  const Scene without = load_obj(unit_square + "f 1 2 3 4\n");
  CHECK(mesh_of(with).positions == mesh_of(without).positions);
  CHECK(mesh_of(with).triangles == mesh_of(without).triangles);
  // The camera is at the origin, so that the square is the whole bounding box.
  CHECK(diameter(with) == std::sqrt(2.0));
  // Nor those of triangles that were left out.
  const Scene thin = load_obj(unit_square + "v 9 0 0\nf 1 2 3 4\nf 1 2 5\n");
  CHECK(diameter(thin) == std::sqrt(2.0));
  const Scene ply =
      load_mesh("ply",
                "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
                "property float z\nelement face 1\nproperty list uchar int vertex_indices\n"
                "end_header\n0 0 0\n1 0 0\n9 9 9\n0 1 0\n3 0 1 3\n");
  CHECK(diameter(ply) == std::sqrt(2.0));
}

TEST_CASE("vertex normals against the winding are noted", "[scene]") {
  const std::string against =
      "the vertex normals of all 1 faces point against their triangles: "
      "flipNormals?";
  const std::string in = unit_square + "vn 0 0 -1\nf 1//1 2//1 3//1 4//1\n";
  const std::string out = unit_square + "vn 0 0 1\nf 1//1 2//1 3//1 4//1\n";
  CHECK(notes_with(load_obj(in, face_normals), "mesh.obj: " + against) == 1);
  CHECK(notes_with(load_obj(in, face_normals + flip_normals), "normals") == 0);
  CHECK(notes_with(load_obj(out, face_normals), "normals") == 0);
  // A reflection affects both.
  const std::string mirror = "<transform name=\"toWorld\"><scale x=\"-1\"/></transform>";
  CHECK(notes_with(load_obj(out, face_normals + mirror), "normals") == 0);
  CHECK(notes_with(load_obj(in, face_normals + mirror), against) == 1);
  const std::string some =
      unit_square + "vn 0 0 -1\nvn 0 0 1\nf 1//1 2//1 3//1\nf 1//-1 3//-1 4//-1\nf 4 3 2\n";
  CHECK(notes_with(load_obj(some, face_normals),
                   "mesh.obj: the vertex normals of 1 of 2 faces point against their triangles") ==
        1);
  // A missing normal has no effect.
  const std::string missing = unit_square + "vn 0 0 -1\nf 1//1 2//2 3//1\n";
  CHECK(notes_with(load_obj(missing, face_normals), "point against") == 0);
}

TEST_CASE("so are those of PLY files", "[scene]") {
  const auto ply = [](const std::string& normal) {
    std::string text =
        "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty "
        "float z\nproperty float nx\nproperty float ny\nproperty float nz\nelement face 1\n"
        "property list uchar int vertex_indices\nend_header\n";
    for (const char* place : {"0 0 0 ", "1 0 0 ", "1 1 0 ", "0 1 0 "})
      text += place + normal + "\n";
    return text + "4 0 1 2 3\n";
  };
  CHECK(notes_with(load_mesh("ply", ply("0 0 1"), face_normals), "normals") == 0);
  CHECK(notes_with(load_mesh("ply", ply("nan nan nan"), face_normals), "normals") == 0);
  CHECK(notes_with(load_mesh("ply", ply("0 0 -1"), face_normals),
                   "mesh.ply: the vertex normals of all 1 faces point against") == 1);
}

TEST_CASE("a PLY's polygons have any number of corners", "[scene]") {
  // three.js 0.187.0 leaves out those with more than four.
  for (const int corners : {3, 4, 5, 6, 7, 255, 256, 1000}) {
    std::string places, face = std::to_string(corners);
    for (int i = 0; i < corners; ++i) {
      const double angle = 2 * std::numbers::pi * i / corners;
      places += fmt::format("{} {} 0\n", std::cos(angle), std::sin(angle));
      face += fmt::format(" {}", i);
    }
    const Scene scene = load_mesh(
        "ply", fmt::format("ply\nformat ascii 1.0\nelement vertex {}\nproperty float x\nproperty "
                           "float y\nproperty float z\nelement face 1\nproperty list ushort int "
                           "vertex_indices\nend_header\n{}{}\n",
                           corners, places, face));
    INFO(corners);
    CHECK(mesh_of(scene).triangles.size() == static_cast<std::size_t>(corners) - 2);
    CHECK(vector_area(mesh_of(scene)).z ==
          Catch::Approx(corners / 2.0 * std::sin(2 * std::numbers::pi / corners)).epsilon(1e-5));
  }
}

}  // namespace
