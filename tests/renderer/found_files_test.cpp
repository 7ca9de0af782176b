// Files as other programs write them, and scenes as people assemble them: each has the radiance of
// its closed form, with both kernels, within 3 standard errors plus the rounding of the closed form
// and the effect of the small field of view (5e-5). Seeds are fixed, so nothing is left to chance;
// another seed would fail with probability 2.7e-3 per render. The meaning of the files is tested in
// tests/common.

#include "common/exr_bytes.h"
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

const fs::path found = source_folder() / "tests/renderer/found_files";

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

std::vector<std::string> split(const std::string& line) {
  std::vector<std::string> parts;
  for (std::size_t at = 0; at != std::string::npos;) {
    const std::size_t end = line.find(" | ", at);
    parts.push_back(line.substr(at, end == std::string::npos ? end : end - at));
    at = end == std::string::npos ? end : end + 3;
  }
  return parts;
}

TEST_CASE("Files as other programs write them have the radiance of their closed forms") {
  std::ifstream table(found / "expected.txt");
  int rows = 0;
  for (std::string line; std::getline(table, line);) {
    if (line.empty() || line[0] == '#') continue;
    INFO(line);
    const std::vector<std::string> parts = split(line);
    REQUIRE(parts.size() == 4);
    std::array<double, 3> exact{};
    std::istringstream(parts[3]) >> exact[0] >> exact[1] >> exact[2];
    std::map<std::string, std::string> parameters{{"file", parts[1]}};
    if (parts[0] == "lit") parameters["type"] = parts[2];
    check_radiance(load_scene(found / (parts[0] + ".xml"), parameters), exact);
    ++rows;
  }
  CHECK(rows >= 27);
}

/// The floor of found_files/under_lamp.xml under these lamps.
Scene under(const std::string& lamps) {
  const common_test::TemporaryFolder folder;
  std::ifstream in(found / "under_lamp.xml");
  std::stringstream text;
  text << in.rdbuf();
  std::string scene = text.str();
  scene.resize(scene.find("  <shape type=\"obj\">"));
  std::ofstream(folder.path() / "scene.xml") << scene << lamps << "</scene>";
  return load_scene(folder.path() / "scene.xml");
}

std::string lamp_of(const std::string& type, const std::string& steps) {
  return fmt::format(
      "<shape type=\"{}\"><transform name=\"toWorld\">{}</transform><emitter type=\"area\"><rgb "
      "name=\"radiance\" value=\"1\"/></emitter></shape>",
      type, steps);
}

TEST_CASE("Two lamps in one place shine as one") {
  const std::string down =
      "<scale value=\".5\"/><rotate x=\"1\" angle=\"90\"/><translate y=\"1\"/>";
  const std::string turned = "<rotate z=\"1\" angle=\"90\"/>" + down;
  const std::string ball = "<scale value=\".5\"/><translate y=\"1.5\"/>";
  const std::string mesh =
      "<string name=\"filename\" value=\"" + (found / "once.obj").string() + "\"/>";
  const std::string mesh_lamp = "<shape type=\"obj\">" + mesh +
                                "<emitter type=\"area\"><rgb name=\"radiance\" value=\"1\"/>"
                                "</emitter></shape>";
  // A square of side 1, a disk of radius 1/2 and a sphere of radius 1/2: rho / pi E.
  const double square = .119725, disk = .1, sphere = .5 / 9;
  struct Case {
    std::string lamps;
    double exact;
  };
  const std::vector<Case> cases = {
      {lamp_of("rectangle", down), square},
      {lamp_of("rectangle", down) + lamp_of("rectangle", down), square},
      {lamp_of("rectangle", down) + lamp_of("rectangle", turned), square},
      {lamp_of("disk", down) + lamp_of("disk", turned) + lamp_of("disk", down), disk},
      {lamp_of("sphere", ball) + lamp_of("sphere", ball), sphere},
      {mesh_lamp + mesh_lamp, square},
      {mesh_lamp + lamp_of("rectangle", down), square}};
  for (const Case& c : cases) {
    INFO(c.lamps);
    check_radiance(under(c.lamps), {c.exact, c.exact, c.exact});
  }
}

TEST_CASE("A sky is black outside of its image's data window") {
  using common_test::Box;
  struct Case {
    Box data;
    double exact;
  };
  const std::vector<Case> cases = {{{0, 0, 3, 1}, .5},  {{0, 0, 3, 0}, .5},   {{0, 0, 1, 0}, .25},
                                   {{1, 0, 2, 1}, .25}, {{3, 0, 3, 0}, .125}, {{-2, -1, 1, 0}, .25},
                                   {{-9, -9, 9, 9}, .5}};
  for (const Case& c : cases) {
    INFO(c.data.left << ' ' << c.data.top << ' ' << c.data.right << ' ' << c.data.bottom);
    const common_test::TemporaryFolder folder;
    // 1 inside the display window, and 9 outside.
    std::vector<std::array<float, 3>> pixels;
    for (int y = c.data.top; y <= c.data.bottom; ++y) {
      for (int x = c.data.left; x <= c.data.right; ++x) {
        const float value = x >= 0 && x < 4 && y >= 0 && y < 2 ? 1 : 9;
        pixels.push_back({value, value, value});
      }
    }
    std::ofstream(folder.path() / "sky.exr", std::ios::binary)
        << common_test::exr_bytes({0, 0, 3, 1}, c.data, pixels);
    fs::copy_file(found / "under_sky.xml", folder.path() / "under_sky.xml");
    check_radiance(load_scene(folder.path() / "under_sky.xml", {{"file", "sky.exr"}}),
                   {c.exact, c.exact, c.exact});
  }
}

}  // namespace
