// Files as other programs write them, and scenes as people assemble them: each has the radiance of
// its closed form, with both kernels, within 3 standard errors plus the rounding of the closed form
// and the effect of the small field of view (5e-5). Seeds are fixed, so nothing is left to chance;
// another seed would fail with probability 2.7e-3 per render. The meaning of the files is tested in
// tests/common.

#include "common/exr_bytes.h"
#include "common/file_table.h"
#include "common/temporary_folder.h"
#include "course/cli/source_folder.h"
#include "scene/load_scene.h"
#include "scene_tools.h"

#include <catch2/catch_test_macros.hpp>
#include <fmt/format.h>

#include <array>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

namespace {

using namespace scene_tools;
namespace fs = std::filesystem;

/// The files of found_files.txt, in a folder.
struct FoundFiles {
  FoundFiles() { common_test::write_files(files, path); }

  std::vector<common_test::TableFile> files =
      common_test::read_file_table(source_folder() / "tests/renderer/found_files.txt");
  common_test::TemporaryFolder folder;
  fs::path path = folder.path();
};

MeanRadiance mean_by(const Scene& scene, renderer::Kernel kernel) {
  constexpr std::uint32_t spp = 1024;
  const auto integrator =
      renderer::make_path_integrator(scene, {.seed = 1, .spp = spp, .kernel = kernel});
  return mean_radiance(
      render(*integrator, scene.width, scene.height, {.spp = spp, .threads = 0, .progress = false})
          .film);
}

void check_radiance(Scene scene, const std::array<double, 3>& exact) {
  scene.sampler = SamplerKind::independent;
  for (const renderer::Kernel kernel : {renderer::Kernel::scalar, renderer::Kernel::best}) {
    const MeanRadiance mean = mean_by(scene, kernel);
    for (std::size_t c = 0; c < 3; ++c) {
      INFO((kernel == renderer::Kernel::scalar ? "scalar" : "best")
           << " kernel, channel " << c << ": " << mean.value[c] << " +- " << mean.standard_error[c]
           << " for " << exact.at(c));
      CHECK(std::abs(mean.value[c] - exact.at(c)) <=
            3 * mean.standard_error[c] + 5e-5 * exact.at(c));
      CHECK(mean.standard_error[c] <= .01 * exact.at(c));
    }
  }
}

TEST_CASE("Files as other programs write them have the radiance of their closed forms") {
  const FoundFiles found;
  int rows = 0;
  for (const common_test::TableFile& file : found.files) {
    if (file.expected.empty()) continue;
    INFO(file.name << " | " << file.expected);
    std::istringstream words(file.expected);
    std::string scene;
    std::array<double, 3> exact{};
    words >> scene >> exact[0] >> exact[1] >> exact[2];
    REQUIRE(words);
    std::map<std::string, std::string> parameters{{"file", file.name}};
    if (scene == "lit") parameters["type"] = fs::path(file.name).extension().string().substr(1);
    check_radiance(load_scene(found.path / (scene + ".xml"), parameters), exact);
    ++rows;
  }
  CHECK(rows >= 26);
}

/// The floor of found_files.txt's under_light.xml under these lights.
Scene under(const FoundFiles& found, const std::string& lights,
            const std::string& version = "0.6.0") {
  std::ifstream in(found.path / "under_light.xml");
  std::stringstream text;
  text << in.rdbuf();
  std::string scene = text.str();
  scene.resize(scene.find("  <shape type=\"obj\">"));
  scene.replace(scene.find("0.6.0"), 5, version);
  std::ofstream(found.path / "scene.xml") << scene << lights << "</scene>";
  return load_scene(found.path / "scene.xml");
}

std::string light_of(const std::string& type, const std::string& steps) {
  return fmt::format(
      "<shape type=\"{}\"><transform name=\"toWorld\">{}</transform><emitter type=\"area\"><rgb "
      "name=\"radiance\" value=\"1\"/></emitter></shape>",
      type, steps);
}

TEST_CASE("Two lights in one place shine as one") {
  const std::string down =
      "<scale value=\".5\"/><rotate x=\"1\" angle=\"90\"/><translate y=\"1\"/>";
  const std::string turned = "<rotate z=\"1\" angle=\"90\"/>" + down;
  const std::string ball = "<scale value=\".5\"/><translate y=\"1.5\"/>";
  const std::string mesh_light =
      "<shape type=\"obj\"><string name=\"filename\" value=\"once.obj\"/><emitter type=\"area\"><rgb "
      "name=\"radiance\" value=\"1\"/></emitter></shape>";
  // A square of side 1, a disk of radius 1/2 and a sphere of radius 1/2: rho / pi E.
  const double square = .119725, disk = .1, sphere = .5 / 9;
  struct Case {
    std::string lights;
    double exact;
  };
  const std::vector<Case> cases = {
      {light_of("rectangle", down), square},
      {light_of("rectangle", down) + light_of("rectangle", down), square},
      {light_of("rectangle", down) + light_of("rectangle", turned), square},
      {light_of("disk", down) + light_of("disk", turned) + light_of("disk", down), disk},
      {light_of("sphere", ball) + light_of("sphere", ball), sphere},
      {mesh_light + mesh_light, square},
      {mesh_light + light_of("rectangle", down), square}};
  const FoundFiles found;
  for (const Case& c : cases) {
    INFO(c.lights);
    check_radiance(under(found, c.lights), {c.exact, c.exact, c.exact});
  }
}

TEST_CASE("A sky is black outside of its image's data window") {
  using common_test::Box;
  constexpr Box small{0, 0, 3, 1}, large{0, 0, 63, 31};
  struct Case {
    Box display, data;
    double exact;
  };
  const std::vector<Case> cases = {{small, {0, 0, 3, 1}, .5},   {small, {0, 0, 3, 0}, .5},
                                   {small, {0, 0, 1, 0}, .25},  {small, {1, 0, 2, 1}, .25},
                                   {small, {3, 0, 3, 0}, .125}, {small, {-2, -1, 1, 0}, .25},
                                   {small, {-9, -9, 9, 9}, .5}, {large, {0, 0, 31, 15}, .25}};
  const FoundFiles found;
  for (const Case& c : cases) {
    INFO(c.data.left << ' ' << c.data.top << ' ' << c.data.right << ' ' << c.data.bottom);
    // 1 in the display window, and 9 outside.
    std::vector<std::array<float, 3>> pixels;
    for (int y = c.data.top; y <= c.data.bottom; ++y) {
      for (int x = c.data.left; x <= c.data.right; ++x) {
        const bool shown = x >= 0 && x <= c.display.right && y >= 0 && y <= c.display.bottom;
        const float value = shown ? 1 : 9;
        pixels.push_back({value, value, value});
      }
    }
    std::ofstream(found.path / "sky.exr", std::ios::binary)
        << common_test::exr_bytes(c.display, c.data, pixels);
    check_radiance(load_scene(found.path / "under_sky.xml", {{"file", "sky.exr"}}),
                   {c.exact, c.exact, c.exact});
  }
}

TEST_CASE("A sky of halves or of whole numbers is as bright as its numbers say") {
  // OpenImageIO 3.2.2 reads whole numbers as fractions of the largest: 1 would be 2.3e-10.
  using common_test::ExrType;
  constexpr common_test::Box box{0, 0, 3, 1};
  const FoundFiles found;
  struct Case {
    ExrType type;
    std::array<std::uint32_t, 3> words;
    std::array<double, 3> exact;  ///< half of their numbers
  };
  const std::vector<Case> cases = {{ExrType::half, {0x3c00, 0x3800, 0x6801}, {.5, .25, 1025}},
                                   {ExrType::whole, {1, 2, 1000}, {.5, 1, 500}}};
  for (const Case& c : cases) {
    std::ofstream(found.path / "sky.exr", std::ios::binary)
        << common_test::exr_bytes_of(c.type, box, box, {8, c.words});
    check_radiance(load_scene(found.path / "under_sky.xml", {{"file", "sky.exr"}}), c.exact);
  }
}

TEST_CASE("A mirrored mesh shines to its front in 0.6, and to its back in Mitsuba 3") {
  const FoundFiles found;
  const std::string mirrored =
      "<shape type=\"obj\"><string name=\"filename\" value=\"once.obj\"/><transform "
      "name=\"toWorld\"><scale x=\"-1\"/></transform><emitter type=\"area\"><rgb "
      "name=\"radiance\" value=\"1\"/></emitter></shape>";
  check_radiance(under(found, mirrored), {.119725, .119725, .119725});
  check_radiance(under(found, mirrored, "3.0.0"), {0, 0, 0});
}

}  // namespace
