// OpenEXR files as other programs write them: windows, parts, tiles, colours.

#include "course/cli/source_folder.h"
#include "exr_bytes.h"
#include "file_table.h"
#include "image/exr.h"
#include "image/primaries.h"
#include "mesh_helpers.h"
#include "support/atomic_file.h"
#include "support/error.h"

#include <catch2/catch_approx.hpp>
#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers_string.hpp>
#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

namespace {

using namespace carlo;
using namespace common_test;
using Catch::Matchers::ContainsSubstring;

using Pixels = std::vector<std::array<float, 3>>;

ExrFile read_bytes(const std::string& bytes) {
  const TemporaryFolder scratch;
  write_file(scratch.path() / "a.exr", bytes);
  return read_exr(scratch.path() / "a.exr");
}

std::string read_error(const std::string& bytes) {
  try {
    read_bytes(bytes);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

/// Data in which the pixel at column x, row y of the display window's coordinates is x + 100 y,
/// red.
std::string with_windows(Box display, Box data) {
  Pixels pixels;
  for (int y = data.top; y <= data.bottom; ++y) {
    for (int x = data.left; x <= data.right; ++x)
      pixels.push_back({static_cast<float>(x + 100 * y), .5f, 0});
  }
  return exr_bytes(display, data, pixels);
}

TEST_CASE("Of an EXR's counts none is read where they do not fill its image") {
  const TemporaryFolder scratch;
  const auto path = scratch.path() / "a.exr";
  const Box data{0, 0, 1, 0};
  for (const Box& display : {data, Box{0, 0, 5791, 5791}}) {  // almost 2^25 pixels
    write_file(path, exr_bytes_of(ExrType::whole, display, data, {{1, 2, 3}, {4, 5, 6}}));
    const auto counts = read_exr(path, {"R", "G"}).counts;
    CHECK(counts.size() == (display.right == data.right ? 2 : 0));
    if (!counts.empty()) CHECK(counts.at("G") == std::vector<std::uint32_t>{2, 5});
  }
}

TEST_CASE("An EXR's image is its display window, black where it has no data") {
  const Box display{10, 20, 13, 21};
  const std::vector<Box> windows = {{10, 20, 13, 21}, {11, 20, 12, 20}, {8, 18, 15, 25},
                                    {9, 21, 11, 24},  {13, 20, 13, 20}, {0, 0, 20, 20},
                                    {-5, -5, -4, -4}, {11, 0, 11, 40}};
  for (const Box& data : windows) {
    INFO(data.left << ' ' << data.top << ' ' << data.right << ' ' << data.bottom);
    const ExrFile file = read_bytes(with_windows(display, data));
    REQUIRE(file.image.width == 4);
    REQUIRE(file.image.height == 2);
    bool all = true, more = data.left < 10 || data.right > 13 || data.top < 20 || data.bottom > 21;
    for (int y = 0; y < 2; ++y) {
      for (int x = 0; x < 4; ++x) {
        const int column = 10 + x, row = 20 + y;
        const bool there =
            column >= data.left && column <= data.right && row >= data.top && row <= data.bottom;
        all = all && there;
        const auto red = static_cast<float>(column + 100 * row);
        CHECK(file.image.at(x, y) == (there ? Rgb(red, .5f, 0) : Rgb(0)));
      }
    }
    CHECK(file.notes.empty() == (all && !more));
    if (file.notes.empty()) continue;
    CHECK(file.notes.size() == 1);
    CHECK((file.notes[0].find("the rest is black") != std::string::npos) == !all);
    CHECK((file.notes[0].find("what is outside is left out") != std::string::npos) == more);
  }
}

TEST_CASE("An EXR's display window has a size that an image may have") {
  const Pixels one = {{1, 1, 1}};
  CHECK_THAT(read_error(exr_bytes({0, 0, 99999, 99999}, {0, 0, 0, 0}, one)),
             ContainsSubstring("its display window has 100000 x 100000 pixels"));
  const ExrFile wide = read_bytes(exr_bytes({0, 0, 1999, 999}, {1999, 999, 1999, 999}, one));
  CHECK(wide.image.pixels.size() == 2'000'000);
  CHECK(wide.image.at(1999, 999) == Rgb(1));
}

TEST_CASE("An image around a scene is measured by its display window") {
  const TemporaryFolder folder;
  const auto load = [&](Box display, Box data) {
    write_file(folder.path() / "sky.exr", with_windows(display, data));
    write_file(folder.path() / "scene.xml",
               "<scene version=\"0.6.0\"><sensor type=\"perspective\"><float name=\"fov\" "
               "value=\"90\"/></sensor><emitter type=\"envmap\"><string name=\"filename\" "
               "value=\"sky.exr\"/></emitter></scene>");
    return load_scene(folder.path() / "scene.xml");
  };
  const Scene scene = load({0, 0, 3, 1}, {0, 0, 3, 0});
  REQUIRE(scene.lights.envmap);
  CHECK(scene.lights.envmap->image.width == 4);
  CHECK(scene_test::notes_with(scene, "sky.exr: its data window has 4 x 1 pixels") == 1);
  CHECK_THROWS_WITH(
      load({0, 0, 3, 0}, {0, 0, 3, 1}),
      ContainsSubstring("\"sky.exr\" has a display window of 4 x 1 pixels, expected"));
}

TEST_CASE("An EXR of many parts, tiles or resolutions is read, or refused in one line") {
  const TemporaryFolder folder;
  const auto& images = folder.path();
  write_files(read_file_table(source_folder() / "tests/common/images.txt"), images);
  const auto error_of = [&](const std::string& name) -> std::string {
    try {
      read_exr(images / name);
    } catch (const Error& error) {
      CHECK(std::string(error.what()).find('\n') == std::string::npos);
      return error.what();
    }
    return "none";
  };
  for (const std::string name : {"tiled.exr", "mip.exr", "rip.exr"}) {
    INFO(name);
    const ExrFile file = read_exr(images / name);
    CHECK(file.notes.empty());
    REQUIRE((file.image.width == 8 && file.image.height == 4));
    for (int i = 0; i < 32; ++i)
      CHECK(file.image.pixels[static_cast<std::size_t>(i)] ==
            Rgb(static_cast<float>(1 + i), .5f, .25f));
  }
  CHECK(read_exr(images / "decreasing.exr").image.at(0, 1) == Rgb(5, .5f, .25f));
  // Depths first, then colours: twice 1 to 8.
  const ExrFile parts = read_exr(images / "parts_z_rgb.exr");
  CHECK(parts.image.at(3, 1) == Rgb(16, 1, .5f));
  REQUIRE(parts.notes.size() == 1);
  CHECK(parts.notes[0] == "parts_z_rgb.exr: part 2 of its 2 is read, the first with R, G, B");
  CHECK_THAT(error_of("deep.exr"), ContainsSubstring("its pixels are deep"));
  // Luminance and chroma of (1, .5, .25), in halves: OpenImageIO 2.5.18 makes RGB of them, 2.4.7
  // refuses.
  if (const std::string yca = error_of("yca.exr"); yca == "none") {
    for (const Rgb& pixel : read_exr(images / "yca.exr").image.pixels)
      CHECK(glm::length(pixel - Rgb(1, .5f, .25f)) < 0.01f);
  } else {
    CHECK_THAT(yca, ContainsSubstring("Subsampled channels are not supported"));
  }
  CHECK_THAT(error_of("sub.exr"), ContainsSubstring("Subsampled channels are not supported"));
  CHECK_THAT(error_of("y.exr"), ContainsSubstring("it has no channels R, G, B, but Y"));
}

std::string with_chromaticities(const std::vector<float>& xy, const Pixels& pixels) {
  return exr_bytes({0, 0, 1, 0}, {0, 0, 1, 0}, pixels,
                   exr_floats("chromaticities", "chromaticities", xy));
}

TEST_CASE("Rec. 709 that is stated changes no bit") {
  const Pixels pixels = {{.1f, 1e-20f, 3e20f}, {-.3f, .7f, 0}};
  for (const std::vector<float>& xy :
       {std::vector<float>{.64f, .33f, .3f, .6f, .15f, .06f, .3127f, .329f},
        std::vector<float>{.64f, .33f, .3f, .6f, .15f, .06f, .31271f, .32902f},
        std::vector<float>{.64f, .33f, .3f, .6f, .15f, .06f, .313f, .329f}}) {
    const ExrFile file = read_bytes(with_chromaticities(xy, pixels));
    CHECK(file.notes.empty());
    CHECK(file.image.at(0, 0) == Rgb(.1f, 1e-20f, 3e20f));
    CHECK(file.image.at(1, 0) == Rgb(-.3f, .7f, 0));
  }
}

TEST_CASE("Chromaticities are taken to those of Rec. 709: the same X, Y, Z") {
  const auto close = [](Rgb a, Rgb b) {
    INFO(a.r << ' ' << a.g << ' ' << a.b);
    for (int c = 0; c < 3; ++c)
      CHECK(std::abs(a[c] - b[c]) <= 1e-4f);
  };
  // Rec. 2020 has the same white: ITU-R BT.2087's matrix, inverted.
  const ExrFile wide = read_bytes(with_chromaticities(
      {.708f, .292f, .17f, .797f, .131f, .046f, .3127f, .329f}, {{1, 0, 0}, {0, .5f, 0}}));
  close(wide.image.at(0, 0), {1.6605f, -.1246f, -.0182f});
  close(wide.image.at(1, 0), .5f * Rgb(-.5876f, 1.1329f, -.1006f));
  REQUIRE(wide.notes.size() == 1);
  CHECK_THAT(wide.notes[0], ContainsSubstring("a.exr: its chromaticities, red (0.708, 0.292)"));
  // X, Y, Z themselves, with the white of equal energy: IEC 61966-2-1's matrix. D65 is white.
  const ExrFile xyz = read_bytes(
      with_chromaticities({1, 0, 0, 1, 0, 0, 1 / 3.f, 1 / 3.f}, {{1, 0, 0}, {.9505f, 1, 1.089f}}));
  close(xyz.image.at(0, 0), {3.2410f, -.9692f, .0556f});
  for (int c = 0; c < 3; ++c)
    CHECK(std::abs(xyz.image.at(1, 0)[c] - 1) <= 1e-3f);
}

TEST_CASE("A white that is adapted becomes white") {
  // ACES AP1, by the Bradford transform: OpenColorIO's built-in configuration.
  const auto matrix =
      to_rec709({{.713, .293}, {.165, .83}, {.128, .044}, {.32168, .33767}}, White::adapted);
  REQUIRE(matrix);
  const glm::dvec3 red = *matrix * glm::dvec3(1, 0, 0), white = *matrix * glm::dvec3(1);
  CHECK(glm::length(red - glm::dvec3(1.70505, -.13026, -.02400)) <= 1e-4);
  CHECK(glm::length(white - glm::dvec3(1)) <= 1e-4);
}

TEST_CASE("Chromaticities that span no colours are refused") {
  const Pixels pixels = {{1, 1, 1}, {1, 1, 1}};
  for (const std::vector<float>& xy :
       {std::vector<float>{.3f, .3f, .3f, .3f, .3f, .3f, .3f, .3f},
        std::vector<float>{0, 0, 0, 0, 0, 0, 0, 0},
        std::vector<float>{.64f, .33f, .3f, .6f, .15f, .06f, .3f, 0},
        std::vector<float>{.64f, .33f, .3f, .6f, .15f, .06f, std::nanf(""), .3f},
        std::vector<float>{.1f, .1f, .2f, .2f, .3f, .3f, .33f, .33f}})
    CHECK_THAT(read_error(with_chromaticities(xy, pixels)), ContainsSubstring("span no colours"));
}

TEST_CASE("What an EXR says of its white and its pixels' shape is noted") {
  const auto notes = [](const std::string& attribute) {
    return read_bytes(exr_bytes({0, 0, 0, 0}, {0, 0, 0, 0}, {{1, 1, 1}}, attribute)).notes;
  };
  CHECK(notes(exr_floats("whiteLuminance", "float", {100})) ==
        std::vector<std::string>{"a.exr: its whiteLuminance is not used"});
  CHECK(notes(exr_floats("adoptedNeutral", "v2f", {.3f, .3f})) ==
        std::vector<std::string>{"a.exr: its adoptedNeutral is not used"});
  CHECK(notes("").empty());
}

TEST_CASE("An EXR's halves are read exactly, and its whole numbers as they are") {
  const Box box{0, 0, 1, 0};
  // The least half, 2^-24; the largest; 2050, a tie's neighbour; infinity; 1/3 rounded; -0.
  const Image halves =
      read_bytes(exr_bytes_of(ExrType::half, box, box,
                              {{0x0001, 0x7bff, 0x6801}, {0x7c00, 0x3555, 0x8000}}))
          .image;
  CHECK(halves.at(0, 0) == Rgb(0x1p-24f, 65504, 2050));
  CHECK(std::isinf(halves.at(1, 0).r));
  CHECK(halves.at(1, 0).g == 1365 / 4096.f);
  CHECK((halves.at(1, 0).b == 0 && std::signbit(halves.at(1, 0).b)));
  // OpenImageIO 2.4.7 itself gives 1 / (2^32 - 1) for 1: such a sky was black.
  const Image whole = read_bytes(exr_bytes_of(ExrType::whole, box, box,
                                              {{0, 1, 2}, {1'000'000, 1u << 31, 0xffffffff}}))
                          .image;
  CHECK(whole.at(0, 0) == Rgb(0, 1, 2));
  CHECK(whole.at(1, 0) == Rgb(1e6f, 0x1p31f, 0x1p32f));
}

TEST_CASE("An EXR's channels X, Y, Z are not taken for colours") {
  // Mitsuba 3.9.1 converts channels of these names from CIE XYZ; they may be vectors as well.
  const Box box{0, 0, 0, 0};
  CHECK_THAT(read_error(exr_bytes_of(ExrType::single, box, box, {{0, 0, 0}}, "", "XYZ")),
             ContainsSubstring("it has no channels R, G, B, but X, Y, Z"));
}

}  // namespace
