// An environment map as loaded; what the loader refuses is in broken_scenes/.

#include "image/exr.h"
#include "scene/needs.h"
#include "scene_helpers.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <string>

namespace {

using namespace carlo;

/// A scene with a 4 x 2 image around it, in which texel (x, y) is 1 + x + 4 y, red.
Scene under_image(const std::string& properties) {
  const scene_test::TemporaryFolder folder;
  Image image(4, 2);
  for (std::size_t i = 0; i < image.pixels.size(); ++i)
    image.pixels[i] = Rgb(static_cast<float>(1 + i), 0, 0);
  write_exr(folder.path() / "sky.exr", {image});
  scene_test::write_bytes(
      folder.path() / "scene.xml",
      "<scene version=\"0.6.0\"><sensor type=\"perspective\">"
      "<float name=\"fov\" value=\"90\"/></sensor><emitter type=\"envmap\"><string name=\"filename\" "
      "value=\"sky.exr\"/>" +
          properties + "</emitter></scene>");
  return load_scene(folder.path() / "scene.xml");
}

TEST_CASE("an environment map stands beside the file, is scaled and turned", "[scene]") {
  const auto red = [](const Scene& scene, Vec3 d) {
    const Envmap& map = scene.lights.envmap.value();
    return map.image.pixels[texel_at(map, glm::normalize(d))].r;
  };
  const Scene plain = under_image("");
  CHECK(plain.notes.empty());
  CHECK(needs(plain).envmap);
  CHECK(describe(needs(plain)) == "no shapes; no materials; environment map");
  // Up is +y; the left edge is towards -z, and +x is right of it.
  CHECK(red(plain, {.1f, 1, -1}) == 1);
  CHECK(red(plain, {1, 1, .1f}) == 2);
  CHECK(red(plain, {-.1f, -1, 1}) == 7);
  CHECK(red(plain, {-1, -1, -.1f}) == 8);
  CHECK(red(under_image("<float name=\"scale\" value=\"3\"/>"), {1, 1, .1f}) == 6);
  // Rotated so that its +y is +z, as in scenes with z upwards, and mirrored.
  const Scene upright =
      under_image("<transform name=\"toWorld\"><rotate x=\"1\" angle=\"90\"/></transform>");
  CHECK(red(upright, {.1f, 1, 1}) == 1);
  CHECK(red(upright, {1, -.1f, 1}) == 2);
  const Scene mirrored = under_image("<transform name=\"toWorld\"><scale x=\"-1\"/></transform>");
  CHECK(red(mirrored, {-.1f, 1, -1}) == 1);
  CHECK(red(mirrored, {-1, 1, .1f}) == 2);
}

TEST_CASE("a row of an environment map gives the light of its band of the sphere", "[scene]") {
  // Row k of H reaches from the angle pi k / H to pi (k + 1) / H. Mitsuba 3.9.1 has the first and
  // the last row on the poles: there row 0 of 8 gives 44 % of its band, row 3 gives 112 %.
  constexpr int height = 8, steps = 40'000;
  const Envmap map{Image(2 * height, height)};
  std::array<double, height> light{};
  for (int i = 0; i < steps; ++i) {
    // Bands of equal area have equal heights.
    const double y = 1 - (2 * i + 1.0) / steps, x = std::sqrt(1 - y * y);
    light.at(texel_at(map, Vec3(x, y, 0)) / (2 * height)) += 4 * std::numbers::pi / steps;
  }
  for (int row = 0; row < height; ++row) {
    const double top = std::cos(std::numbers::pi * row / height),
                 bottom = std::cos(std::numbers::pi * (row + 1) / height);
    // Off by one step at most at either end.
    CHECK(std::abs(light.at(static_cast<std::size_t>(row)) -
                   2 * std::numbers::pi * (top - bottom)) <= 8 * std::numbers::pi / steps);
  }
}

}  // namespace
