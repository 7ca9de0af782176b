// Scenes from the wild: information that an image does not need is accepted if it changes nothing.

#include "course/cli/source_folder.h"
#include "file_table.h"
#include "scene_helpers.h"
#include "support/error.h"

#include <catch2/catch_test_macros.hpp>

#include <algorithm>
#include <string>
#include <utility>
#include <variant>

using namespace carlo;
using scene_test::load_elements;
using scene_test::load_text;

TEST_CASE("an exponent that floats cannot tell from a smaller one is taken as that", "[scene]") {
  const auto exponent = [](const std::string& value) {
    const Scene scene = load_elements(
        "<emitter type=\"constant\"/><shape type=\"sphere\"><bsdf type=\"phong\"><float "
        "name=\"exponent\" value=\"" +
        value + "\"/></bsdf></shape>");
    return std::pair(std::get<Phong>(scene.materials.at(0).model).exponent, scene.notes.size());
  };
  CHECK(exponent("1e13") == std::pair(1e13f, std::size_t{0}));
  CHECK(exponent("1e16") == std::pair(1e13f, std::size_t{1}));
  CHECK(exponent("3e38") == std::pair(1e13f, std::size_t{1}));
}

TEST_CASE("near and far clip are taken where they cut nothing", "[scene]") {
  // A room around the camera, with a unit sphere three units in front of it.
  const auto loads = [](const std::string& clip) {
    try {
      load_text(
          "<scene version=\"0.6.0\"><sensor type=\"perspective\"><float name=\"fov\" "
          "value=\"90\"/>" +
          clip +
          "</sensor><shape type=\"cube\"><transform name=\"toWorld\"><scale value=\"5\"/>"
          "</transform></shape><shape type=\"sphere\"><point name=\"center\" x=\"0\" y=\"0\" "
          "z=\"3\"/></shape></scene>");
    } catch (const PlacedError&) {
      return false;
    }
    return true;
  };
  const auto near_clip = [](const std::string& depth) {
    return "<float name=\"nearClip\" value=\"" + depth + "\"/>";
  };
  const auto far_clip = [](const std::string& depth) {
    return "<float name=\"far_clip\" value=\"" + depth + "\"/>";
  };
  CHECK(loads(near_clip("0.1") + far_clip("100")));
  // The image's corners are sqrt(1 + 1 + .75^2) times as far: 2 / 1.6.
  CHECK(loads(near_clip("1.24")));
  CHECK_FALSE(loads(near_clip("1.26")));
  CHECK(loads(far_clip("5.001")));
  CHECK_FALSE(loads(far_clip("4.99")));
  CHECK_FALSE(loads(near_clip("0")));
}

TEST_CASE("scenes as they are published are read", "[scene]") {
  const auto files =
      common_test::read_file_table(source_folder() / "tests/common/found_scenes.txt");
  for (const common_test::TableFile& file : files) {
    INFO(file.name);
    CHECK(load_text(file.bytes).lights.environment == Rgb(1));
  }
  CHECK(files.size() >= 8);
}

TEST_CASE("more errors than anybody reads are counted", "[scene]") {
  std::string wrong;
  for (int i = 0; i < 70; ++i)
    wrong += "\n<shape type=\"sphere\"><float name=\"radius\" value=\"-1\"/></shape>";
  try {
    load_elements(wrong);
    FAIL("it loads");
  } catch (const PlacedError& error) {
    const std::string text = error.what();
    CHECK(std::count(text.begin(), text.end(), '\n') == 50);
    CHECK(text.ends_with("scene.xml:52:50: error: and 20 more errors"));
  }
}

TEST_CASE("a scale in a point light's toWorld changes its place, not its intensity", "[scene]") {
  // Mitsuba 3.9.1 multiplies a directional emitter's irradiance by the scale of its to_world.
  for (const std::string scale : {"3", "0.01", "-1"}) {
    const Scene scene = load_elements(
        "<emitter type=\"point\"><transform name=\"toWorld\"><scale value=\"" + scale +
        "\"/><translate y=\"4\"/></transform><rgb name=\"intensity\" value=\"5\"/></emitter>");
    CHECK(scene.lights.points.at(0).intensity == Rgb(5));
    CHECK(scene.lights.points.at(0).position == Vec3(0, 4, 0));
  }
}
