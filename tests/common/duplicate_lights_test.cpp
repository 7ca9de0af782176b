// Lights that coincide exactly: one of each is kept, or the scene is refused.

#include "mesh_helpers.h"
#include "scene/needs.h"

#include <fmt/format.h>

#include <algorithm>
#include <ctime>
#include <string>

namespace {

using namespace carlo;
using namespace scene_test;

std::string at_place(const std::string& steps) {
  return "<transform name=\"toWorld\">" + steps + "</transform>";
}

/// A light of this type, with these elements inside.
std::string light(const std::string& type, const std::string& inside, double radiance = 1) {
  return fmt::format(
      "<shape type=\"{}\">{}<emitter type=\"area\"><rgb name=\"radiance\" value=\"{}\"/></emitter>"
      "</shape>",
      type, inside, radiance);
}

std::string light_error(const std::string& elements) {
  try {
    load_elements(elements);
  } catch (const carlo::Error& error) {
    return error.what();
  }
  return "";
}

/// Checks how many lights are left, and that a note counts the others.
void check_lights(const std::string& elements, std::size_t left, int gone) {
  const Scene scene = load_elements(elements);
  INFO(elements);
  CHECK(needs(scene).area_lights() == left);
  CHECK(notes_with(scene, "left out that lie where others lie") == (gone > 0 ? 1 : 0));
  if (gone > 0) CHECK(notes_with(scene, fmt::format("{} lights left out", gone)) == 1);
}

TEST_CASE("of lights in one place that face the same way one is left", "[scene]") {
  const std::string up = at_place("<translate y=\"1\"/>");
  for (const std::string type : {"rectangle", "disk", "sphere"}) {
    check_lights(light(type, "") + light(type, ""), 1, 1);
    check_lights(light(type, up) + light(type, "") + light(type, up) + light(type, up), 2, 2);
    check_lights(light(type, "") + light(type, flip_normals), 2, 0);
    check_lights(light(type, "") + light(type, at_place("<scale value=\"1.001\"/>")), 2, 0);
    check_lights(light(type, "") + light(type, at_place("<translate z=\"0.0001\"/>")), 2, 0);
  }
  check_lights(light("cube", "") + light("cube", ""), 6, 6);
  check_lights(light("rectangle", "") + light("disk", "") + light("sphere", ""), 3, 0);
  // Lights of radiance 0 are not lights.
  check_lights(light("rectangle", "") + light("rectangle", "", 0), 1, 0);
}

TEST_CASE("a square light is the same from any of its corners", "[scene]") {
  const std::string away =
      "<scale x=\"2\" y=\"2\"/><rotate x=\"1\" y=\"3\" angle=\"40\"/>"
      "<translate x=\"5\" y=\"-7\" z=\"2\"/>";
  for (const std::string angle : {"90", "180", "270", "-90", "360"}) {
    const std::string turn = "<rotate z=\"1\" angle=\"" + angle + "\"/>";
    check_lights(light("rectangle", "") + light("rectangle", at_place(turn)), 1, 1);
    check_lights(light("rectangle", at_place(away)) + light("rectangle", at_place(turn + away)), 1,
                 1);
  }
  check_lights(
      light("rectangle", "") + light("rectangle", at_place("<rotate z=\"1\" angle=\"45\"/>")), 2,
      0);
  // Upside down it faces the other side, mirrored it does not.
  check_lights(
      light("rectangle", "") + light("rectangle", at_place("<rotate x=\"1\" angle=\"180\"/>")), 2,
      0);
  check_lights(light("rectangle", "") + light("rectangle", at_place("<scale x=\"-1\"/>")), 1, 1);
  check_lights(light("disk", "") + light("disk", at_place("<rotate z=\"1\" angle=\"33\"/>")), 1, 1);
}

TEST_CASE("lights in one place that differ are refused", "[scene]") {
  const std::string error = light_error(light("rectangle", "") + light("rectangle", "", 2));
  INFO(error);
  CHECK(error.find(":1:1: error: two lights lie in one place, facing the same way, and differ in "
                   "radiance") != std::string::npos);
  CHECK(error.find("of radiances (1, 1, 1) and (2, 2, 2)") != std::string::npos);
  const std::string white = "<bsdf type=\"diffuse\"/>";
  CHECK(light_error(light("sphere", "") + light("sphere", white)).find("differ in material") !=
        std::string::npos);
  check_lights(light("sphere", white) + light("sphere", white), 1, 1);
}

TEST_CASE("triangles of lights of different meshes coincide", "[scene]") {
  const TemporaryFolder folder;
  write_bytes(folder.path() / "a.obj", unit_square + "f 1 2 3 4\n");
  write_bytes(folder.path() / "b.obj", "v 5 5 5\n" + unit_square + "f 3 4 2\nf 4 5 2\nf 2 3 1\n");
  write_bytes(folder.path() / "c.obj", unit_square + "f 4 3 2 1\n");
  write_bytes(folder.path() / "d.obj", "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nf 2 3 4 1\n");
  const auto load = [&](const std::string& elements) {
    write_bytes(folder.path() / "scene.xml",
                "<scene version=\"0.6.0\"><sensor type=\"perspective\"><float name=\"fov\" "
                "value=\"90\"/></sensor>" +
                    elements + "</scene>");
    return load_scene(folder.path() / "scene.xml");
  };
  const auto mesh = [](const std::string& name, double radiance = 1) {
    return light("obj", "<string name=\"filename\" value=\"" + name + ".obj\"/>", radiance);
  };
  const auto lights = [&](const std::string& elements) {
    return needs(load(elements)).area_lights();
  };
  CHECK(lights(mesh("a") + mesh("a")) == 2);
  CHECK(load(mesh("a") + mesh("a")).shapes.size() == 1);
  CHECK(notes_with(load(mesh("a") + mesh("a") + mesh("a")), "4 triangles of lights left out") == 1);
  CHECK(lights(mesh("a") + mesh("c")) == 4);
  CHECK(lights(mesh("a") + mesh("b")) == 3);
  // Each is half of a rectangle.
  CHECK(lights(mesh("d") + light("rectangle", "")) == 1);
  CHECK(lights(mesh("a") + light("rectangle", "")) == 3);
  CHECK_THROWS(load(mesh("a") + mesh("a", 2)));
}

TEST_CASE("many lights are compared in little time", "[scene]") {
  // Processor time for 16 times as many should be about 16 times as much; comparing all pairs would
  // take 256 times.
  const auto clock_ticks = [](std::size_t count) {
    std::string text;
    for (std::size_t i = 0; i < count; ++i) {
      text += light("rectangle",
                    at_place(fmt::format("<translate x=\"{}\" y=\"{}\"/>", i % 50, i / 50)));
    }
    const std::clock_t start = std::clock();
    check_lights(text + light("rectangle", ""), count, 1);
    return static_cast<double>(std::clock() - start);
  };
  const double few = std::min({clock_ticks(250), clock_ticks(250), clock_ticks(250)});
  CHECK(clock_ticks(4000) < 80 * few);
}

}  // namespace
