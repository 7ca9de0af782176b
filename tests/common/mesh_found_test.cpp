// Meshes as other programs write them: what is skipped, what is noted and what is refused.

#include "course/cli/source_folder.h"
#include "mesh_helpers.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <string>
#include <vector>

namespace {

using namespace carlo;
using namespace scene_test;

const std::string utf8_mark = "\xef\xbb\xbf";

void check_has(const std::string& text, const std::string& phrase) {
  INFO(text);
  CHECK(text.find(phrase) != std::string::npos);
}

TEST_CASE("a byte order mark before a mesh is passed over, that of UTF-16 is named", "[scene]") {
  for (const std::string first : {"", "# exported\n", "mtllib light.mtl\n", "\n"})
    CHECK(area(mesh_of(
              load_obj(fmt::format("{}{}{}f 1 2 3 4\n", utf8_mark, first, unit_square)))) == 1);
  CHECK(area(mesh_of(load_obj(utf8_mark + "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"))) == .5);
  const std::string wide("\xff\xfev\0 \0", 6);
  check_has(mesh_error("obj", wide), "mesh.obj:1: the file is in UTF-16, expected ASCII or UTF-8");
  check_has(mesh_error("obj", "\xfe\xff"), "UTF-16");
  check_has(mesh_error("ply", wide), "mesh.ply:1: the file is in UTF-16");
}

TEST_CASE("a statement of an OBJ goes on after a backslash", "[scene]") {
  for (const std::string end : {"\n", "\r\n"}) {
    std::string text = unit_square + "f 1 2 \\\n  3 4\n";
    CHECK(area(mesh_of(load_obj("v 0 0 \\\n0\nv 1 \\\n 0 \\\n0\nv 0 1 0\nf 1\\\n 2 3"))) == .5);
    for (std::size_t at = text.find('\n'); at != std::string::npos;
         at = text.find('\n', at + end.size()))
      text.replace(at, 1, end);
    CHECK(area(mesh_of(load_obj(text))) == 1);
    // Blanks may follow it, and the file may end there.
    CHECK(area(mesh_of(load_obj(fmt::format("{}f 1 2 \\ {}3 4 \\", unit_square, end)))) == 1);
  }
  // Not from a comment; an error names the first line, and counting of lines continues.
  CHECK(area(mesh_of(load_obj("# C:\\\n" + unit_square + "f 1 2 3 4 # \\\n"))) == 1);
  check_has(mesh_error("obj", unit_square + "f 1 2 \\\n3 x\n"), "mesh.obj:5: expected a vertex");
  check_has(mesh_error("obj", unit_square + "f 1 2 \\\n3 4\nf 1 2 9"),
            "mesh.obj:7: vertex 9 is out");
}

TEST_CASE("statements of an OBJ that change no polygon are passed over with one note", "[scene]") {
  const std::string face = "f 1 2 3 4\n";
  const std::vector<std::string> statements = {
      "t 0 1 0 0",   "vw 1 0 .5",          "lod 3",         "usemap off",       "bevel on",
      "c_interp on", "d_interp off",       "mg 0",          "mg 1 0.5",         "shadow_obj a.obj",
      "trace_obj b", "maplib a.map b.map", "ctech cparm 1", "stech cparma 1 1", "vp .3 .4"};
  for (const std::string& statement : statements) {
    INFO(statement);
    const std::string text = fmt::format("{0}{1}\n{2}{1}\n", unit_square, statement, face);
    const Scene scene = load_obj(text);
    CHECK(area(mesh_of(scene)) == 1);
    const std::string keyword = statement.substr(0, statement.find(' '));
    CHECK(notes_with(scene, "mesh.obj: " + keyword + " changes no polygon and is not used") == 1);
  }
  CHECK(notes_with(load_obj(unit_square + "mg 0\nbevel on\n" + face), "mg, bevel changes") == 1);
  for (const std::string statement : {"vt 0 0", "vn 0 0 1", "o a", "g", "s off", "mtllib a.mtl"})
    CHECK(load_obj(fmt::format("{}{}\n{}", unit_square, statement, face)).notes.size() ==
          1);  // without a light
}

TEST_CASE("statements of an OBJ that make other geometry are refused by name", "[scene]") {
  for (const std::string keyword :
       {"curv", "curv2", "surf", "cstype", "deg", "bmat", "step", "parm", "trim", "hole", "scrv",
        "sp", "end", "con", "call", "csh"}) {
    check_has(mesh_error("obj", unit_square + keyword + " 1 2\nf 1 2 3\n"),
              fmt::format("mesh.obj:5: \"{}\" is for geometry that is not supported", keyword));
  }
  check_has(mesh_error("obj", "faces 1 2 3\n"), "mesh.obj:1: \"faces\" is not understood");
}

const std::string square_places = "-1 0 1\n1 0 1\n1 0 -1\n-1 0 -1\n";

std::string ply_text(const std::string& vertex_properties, const std::string& faces,
                     const std::string& body, int vertices = 4) {
  return fmt::format(
      "ply\nformat ascii 1.0\nelement vertex {}\nproperty float x\nproperty float y\n"
      "property float z\n{}{}end_header\n{}",
      vertices, vertex_properties, faces, body);
}

const std::string one_face_element = "element face 1\nproperty list uchar int vertex_indices\n";

TEST_CASE("what no use is made of in a PLY may be any number", "[scene]") {
  for (const std::string value : {"nan", "-nan", "NaN", "inf", "-Infinity", "1e400", "1.#QNAN",
                                  "-1.#IND", "-nan(ind)", "3", "+.5"}) {
    const Scene scene = load_mesh(
        "ply", ply_text("property float deviation\n", one_face_element,
                        "-1 0 1 " + value + "\n1 0 1 0\n1 0 -1 0\n-1 0 -1 0\n4 0 1 2 3\n"));
    CHECK(area(mesh_of(scene)) == 4);
    CHECK(notes_with(scene, "vertex's \"deviation\" is not used") == 1);
  }
  const std::string list =
      "element face 1\nproperty list uchar int vertex_indices\n"
      "property list uchar float quality\n";
  CHECK(area(mesh_of(
            load_mesh("ply", ply_text("", list, square_places + "4 0 1 2 3 2 nan inf\n")))) == 4);
}

TEST_CASE("errors in the text of a PLY name their line and the property", "[scene]") {
  const auto error_of = [](const std::string& body) {
    return mesh_error("ply", ply_text("property float q\n", one_face_element, body));
  };
  check_has(error_of("-1 0 1 0\n1 nan 1 0\n"), "mesh.ply:12: expected a finite number for y");
  check_has(error_of("-1 0 1 0\n\n1 0 1 x\n"), "mesh.ply:13: expected a number for q, got \"x\"");
  const std::string good = "-1 0 1 0\n1 0 1 0\n1 0 -1 0\n-1 0 -1 0\n";
  check_has(error_of(good + "4 0 1 2 -3\n"),
            "mesh.ply:15: expected a count or an index for vertex_indices, got -3");
  check_has(error_of(good + "4 0 1\n2"), "mesh.ply:16: the file ends too early");
  check_has(error_of(good + "4 0 1 2 3\n5\n"), "mesh.ply:16: there is more data");
  check_has(error_of(good + "4 0 1 2 4\n"), "mesh.ply:15: vertex 4 is out of range: there are 4");
}

/// The bytes of a number, big- or little-endian.
template <class T>
std::string bytes_of_number(T value, bool big) {
  auto raw = std::bit_cast<std::array<char, sizeof(T)>>(value);
  if (big == (std::endian::native == std::endian::little)) std::reverse(raw.begin(), raw.end());
  return {raw.begin(), raw.end()};
}

std::string binary_ply(bool big) {
  std::string text = fmt::format(
      "ply\nformat binary_{}_endian 1.0\nelement vertex 4\nproperty double x\nproperty float y\n"
      "property short z\nproperty double q\nproperty list ushort float unused\nelement face 1\n"
      "property list uint int vertex_index\nend_header\n",
      big ? "big" : "little");
  for (int i = 0; i < 4; ++i) {
    text += bytes_of_number<double>(i == 1 || i == 2 ? .75 : -.25, big) +
            bytes_of_number<float>(0, big) +
            bytes_of_number<std::int16_t>(static_cast<std::int16_t>(i < 2 ? 300 : -1), big) +
            bytes_of_number<double>(1e300, big) + bytes_of_number<std::uint16_t>(1, big) +
            bytes_of_number<float>(0, big);
  }
  text += bytes_of_number<std::uint32_t>(4, big);
  for (int i = 0; i < 4; ++i)
    text += bytes_of_number<std::int32_t>(i, big);
  return text;
}

TEST_CASE("a binary PLY has its bytes in either order", "[scene]") {
  for (const bool big : {false, true}) {
    const std::string text = binary_ply(big);
    CHECK(area(mesh_of(load_mesh("ply", text))) == 301);
    CHECK(vector_area(mesh_of(load_mesh("ply", text))).y == 301);
    // A line end after the data comes from an editor; anything more is not a mesh.
    CHECK(notes_with(load_mesh("ply", text + "\n"), "an end of line follows the last value") == 1);
    CHECK(notes_with(load_mesh("ply", text + "\r\n"), "an end of line follows") == 1);
    check_has(mesh_error("ply", text + "\n\n"), "there is more data than the header announces");
    for (std::size_t cut = text.size() - 1; cut + 40 > text.size(); --cut)
      check_has(mesh_error("ply", text.substr(0, cut)), "the file ends too early");
  }
  const std::string marked = utf8_mark + binary_ply(false);
  CHECK(area(mesh_of(load_mesh("ply", marked))) == 301);
}

TEST_CASE("a PLY's strips of triangles turn every other one, and begin anew after -1", "[scene]") {
  const std::string strips = "element tristrips 1\nproperty list int int vertex_indices\n";
  const auto of = [&](const std::string& body, int vertices = 4) {
    return load_mesh("ply", ply_text("", strips, square_places + body, vertices));
  };
  const Scene square = of("4 0 1 3 2\n");
  CHECK(mesh_of(square).triangles.size() == 2);
  CHECK(vector_area(mesh_of(square)).y == 4);
  CHECK(vector_area(mesh_of(of("7 0 1 3 -1 1 2 3\n"))).y == 4);
  CHECK(vector_area(mesh_of(of("9 -1 0 1 3 -1 -1 1 2 3\n"))).y == 4);
  // Strips are joined by repeated corners, whose triangles have no area.
  CHECK(vector_area(mesh_of(of("9 0 1 3 3 1 1 1 2 3\n"))).y == 4);
  const Scene longer = of("-1 0 -3\n1 0 -3\n6 0 1 3 2 4 5\n", 6);
  CHECK(area(mesh_of(longer)) == Catch::Approx(glm::length(vector_area(mesh_of(longer)))));
  const std::string both = one_face_element + strips;
  CHECK(area(mesh_of(load_mesh("ply", ply_text("", both, square_places + "3 0 1 3\n3 1 2 3\n")))) ==
        4);
  check_has(mesh_error("ply", ply_text("", strips, square_places + "3 0 1 7\n")),
            "mesh.ply:14: vertex 7 is out of range: there are 4");
  check_has(mesh_error("ply", ply_text("", strips, square_places + "3 0 1 -2\n")), "got -2");
  check_has(mesh_error("ply", ply_text("", "", square_places)),
            "expected one list vertex_indices of the");
}

TEST_CASE("an OBJ's relative numbers count back from the vertices above", "[scene]") {
  // Mitsuba 3.9.1 refuses them ("invalid vertex 4294967292"), meshio 5.3.5 reads them one off.
  const std::string away = "v 9 9 9\n";
  CHECK(area(mesh_of(load_obj(unit_square + "f -4 -3 -2 -1\n" + away))) == 1);
  CHECK(area(mesh_of(load_obj(unit_square + away + "f -5 -4 -3 -2\n"))) == 1);
  CHECK(area(mesh_of(load_obj(unit_square + "f 1 -3 3 -1\n"))) == 1);
  const Scene shining = load_obj(
      unit_square + "vt 0 0\nvn 0 0 1\nf -4/-1/-1 -3/-1/-1 -2/-1/-1 -1/-1/-1\n", face_normals);
  CHECK(vector_area(mesh_of(shining)).z == 1);
  check_has(mesh_error("obj", unit_square + "f -5 -2 -1\n"),
            "mesh.obj:5: vertex -5 is out of range: 4 stand above");
  check_has(mesh_error("obj", unit_square + "f 0 1 2\n"),
            "mesh.obj:5: vertex 0 is out of range: the first is 1");
}

TEST_CASE("a corner of an OBJ's face is one to three numbers", "[scene]") {
  for (const std::string corner : {"3/x", "3/x/", "3/1.5", "3/1/1/1", "3///", "3/x/1", "3//1/"}) {
    check_has(
        mesh_error("obj", fmt::format("{}vn 0 0 1\nf 1 2 {}\n", unit_square, corner), face_normals),
        fmt::format("mesh.obj:6: expected v, v/vt, v//vn or v/vt/vn, all numbers, got \"{}\"",
                    corner));
  }
  // Texture coordinates that are not there do no harm.
  CHECK(area(mesh_of(load_obj(unit_square + "f 1/7 2/8 3/9 4/-1\n"))) == 1);
}

TEST_CASE("lines and points of an OBJ leave its polygons alone, and are no mesh", "[scene]") {
  // three.js 0.170.0 turns an object's triangles into lines for one line among them.
  const Scene scene = load_obj("p 1\n" + unit_square + "l 1 2\nf 1 2 3 4\nl 1/1 2/2\np 1 2\n");
  CHECK(area(mesh_of(scene)) == 1);
  CHECK(notes_with(scene, "mesh.obj: 4 lines and points left out") == 1);
  check_has(mesh_error("obj", unit_square + "l 1 2 3 4\n"),
            "is empty: it has no faces (mesh.obj: 1 lines and points left out)");
}

TEST_CASE("what is wrong with a number of an OBJ or PLY is told as it is", "[scene]") {
  check_has(mesh_error("obj", "v 0 0 0 2\n"),
            "mesh.obj:1: the fourth number of a vertex, w, must be 1, got 2");
  check_has(mesh_error("obj", "v 0 0,5 0\n"), "mesh.obj:1: expected a finite number, got \"0,5\"");
  check_has(mesh_error("obj", "v 0 -1e39 0\n"),
            "mesh.obj:1: expected a number within float's range, got \"-1e39\"");
  check_has(mesh_error("ply", ply_text("", one_face_element, "0 0 1e400\n")),
            "mesh.ply:10: expected a number within float's range for z, got \"1e400\"");
  // Bytes that are no UTF-8 are shown as such; a long word is not cut inside a character.
  check_has(mesh_error("obj", "v 0 \xff\xfe\xc3 0\n"), "got \"\\xff\\xfe\\xc3\"");
  std::string umlauts = "x";
  for (int i = 0; i < 40; ++i)
    umlauts += "\xc3\xa4";
  check_has(mesh_error("obj", "v 0 " + umlauts + " 0\n"),
            "got \"" + umlauts.substr(0, 59) + "...\"");
}

TEST_CASE("lines may end as old Macintoshes ended them", "[scene]") {
  const auto with_returns = [](std::string text) {
    std::replace(text.begin(), text.end(), '\n', '\r');
    return text;
  };
  const std::string square = unit_square + "# f 1 2 3\nf 1 2 3 4\n";
  CHECK(area(mesh_of(load_obj(with_returns(square)))) == 1);
  CHECK(area(mesh_of(load_obj(with_returns(unit_square + "f 1 2 \\\n3 4\n")))) == 1);
  check_has(mesh_error("obj", with_returns(square + "f 1 2 9\n")), "mesh.obj:7: vertex 9 is out");
  const std::string ascii = ply_text("", one_face_element, square_places);
  CHECK(area(mesh_of(load_mesh("ply", with_returns(ascii + "4 0 1 2 3\n")))) == 4);
  check_has(mesh_error("ply", with_returns(ascii + "4 0 1 2 x\n")), "mesh.ply:14: expected a");
  // The data begin behind one end of line, even if their first byte is a line feed.
  std::string header =
      "ply\nformat binary_little_endian 1.0\nelement skipped 1\nproperty uchar a\n"
      "element vertex 3\nproperty uchar x\nproperty uchar y\nproperty uchar z\n" +
      one_face_element + "end_header\n";
  const std::string data("\n\0\0\0\2\0\0\0\2\0\3\0\0\0\0\1\0\0\0\2\0\0\0", 23);
  CHECK(area(mesh_of(load_mesh("ply", with_returns(header) + data))) == 2);
  CHECK(area(mesh_of(load_mesh("ply", header + data))) == 2);
}

}  // namespace
