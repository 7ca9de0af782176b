// Scenes that mean something else in a version of Mitsuba: what they mean here, and what is noted.

#include "mesh_helpers.h"

#include <string>
#include <variant>
#include <vector>

namespace {

using namespace carlo;
using namespace scene_test;

std::vector<std::string> notes_of_step(const std::string& version, const std::string& step) {
  return load_text("<scene version=\"" + version +
                   "\"><sensor type=\"perspective\"><float name=\"fov\" value=\"40\"/></sensor>"
                   "<emitter type=\"constant\"/><shape type=\"cube\"><transform name=\"toWorld\">" +
                   step + "</transform></shape></scene>")
      .notes;
}

TEST_CASE("a long axis of a rotation is noted in files of Mitsuba 3, which scales by it",
          "[scene]") {
  const auto notes = [](const std::string& version, const std::string& axis) {
    return notes_of_step(version, "<rotate " + axis + " angle=\"30\"/>");
  };
  const std::string note =
      "<rotate> about an axis of length 2 only turns, as in Mitsuba 0.6; Mitsuba 3 scales as well";
  CHECK(notes("3.0.0", "z=\"2\"") == std::vector{note});
  CHECK(notes("3.0.0", "value=\"0, -2, 0\"") == std::vector{note});
  CHECK(notes("0.6.0", "z=\"2\"").empty());
  CHECK(notes("3.0.0", "z=\"1\"").empty());
  CHECK(notes("3.0.0", "x=\"0.577\" y=\"0.577\" z=\"0.577\"").empty());
}

TEST_CASE("a lookat without up is noted, since Mitsuba's up is any", "[scene]") {
  // From (1, 2, 5), Mitsuba 3.9.1 turns the image by about a quarter.
  for (const std::string version : {"0.6.0", "3.0.0"}) {
    const std::string look = "<lookAt origin=\"1 2 5\" target=\"0 0 0\"";
    CHECK(notes_of_step(version, look + "/>") ==
          std::vector<std::string>{"<lookAt> without up: (0, 1, 0) is up; Mitsuba takes any "
                                   "direction across the view"});
    CHECK(notes_of_step(version, look + " up=\"0 1 0\"/>").empty());
  }
}

/// A unit square in an OBJ file, facing +z, in a scene of this version, and these elements inside.
Scene square_in(const std::string& version, const std::string& inside) {
  const TemporaryFolder folder;
  write_bytes(folder.path() / "square.obj", unit_square + "f 1 2 3 4\n");
  write_bytes(folder.path() / "scene.xml",
              "<scene version=\"" + version +
                  "\"><sensor type=\"perspective\"><float name=\"fov\" value=\"45\"/></sensor>"
                  "<shape type=\"obj\"><string name=\"filename\" value=\"square.obj\"/>" +
                  inside + "</shape></scene>");
  return load_scene(folder.path() / "scene.xml");
}

TEST_CASE("a mirrored mesh is turned inside out in files of Mitsuba 3, not in those of 0.6",
          "[scene]") {
  const auto up = [](const std::string& version, const std::string& steps,
                     const std::string& more = "") {
    const Scene scene =
        square_in(version, "<transform name=\"toWorld\">" + steps + "</transform>" + more);
    return vector_area(mesh_of(scene)).z;
  };
  const std::string x = "<scale x=\"-1\"/>", z = "<scale z=\"-1\"/>", both = x + z;
  // The square that was mirrored across its own plane faces -z.
  CHECK(up("0.6.0", x) == 1);
  CHECK(up("0.6.0", z) == -1);
  CHECK(up("0.6.0", both) == -1);
  // As rendered by Mitsuba 3.9.1, with faceNormals and without, from OBJ and PLY.
  CHECK(up("3.0.0", x) == -1);
  CHECK(up("3.0.0", z) == 1);
  CHECK(up("3.0.0", both) == -1);
  CHECK(up("3.0.0", x, flip_normals) == 1);
  CHECK(up("3.0.0", "<scale value=\"-1\"/>") == 1);
  const std::string mirror = "<transform name=\"toWorld\">" + x + "</transform>";
  CHECK(notes_with(
            square_in("3.0.0", mirror),
            "square.obj: its toWorld mirrors it; this turns it inside out, as in Mitsuba 3") == 1);
  CHECK(notes_with(square_in("0.6.0", mirror),
                   "its outside stays outside, where Mitsuba turns it inside out") == 1);
  CHECK(notes_with(square_in("3.0.0", ""), "mirrors") == 0);
}

}  // namespace
