// Scenes that must be refused: the tables of broken_scenes/ hold them beside the place of each of
// their mistakes and a phrase of the message.

#include "course/cli/source_folder.h"
#include "file_table.h"
#include "random/rng.h"
#include "scene/load_scene.h"
#include "scene_helpers.h"
#include "support/error.h"

#include <catch2/catch_test_macros.hpp>
#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <sstream>
#include <string>
#include <vector>

namespace fs = std::filesystem;
using scene_test::TemporaryFolder;
using scene_test::write_bytes;

namespace {

const fs::path source_dir = carlo::source_folder();
const fs::path broken = source_dir / "tests/common/broken_scenes";

/// The tables' files, in a folder.
struct BrokenScenes {
  BrokenScenes() { common_test::write_files(files, folder.path()); }

  std::vector<common_test::TableFile> files = common_test::read_file_tables(broken);
  TemporaryFolder folder;
};

std::vector<std::string> lines_of(const std::string& message) {
  std::istringstream in(message);
  std::vector<std::string> out;
  for (std::string line; std::getline(in, line);)
    out.push_back(line);
  return out;
}

/// The message of the Error that loading throws; empty if it loads. Any other exception fails the
/// calling test.
std::string error_of(const fs::path& path,
                     const std::map<std::string, std::string>& parameters = {}) {
  try {
    carlo::load_scene(path, parameters);
  } catch (const carlo::Error& error) {
    return error.what();
  }
  return "";
}

std::string bytes_of(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

/// `bytes` with one to four bytes changed, removed or doubled, or truncated.
std::string mutated(std::string bytes, carlo::Rng& rng) {
  static const std::string interesting = "<>\"'/=-$&.09eE \n\xff\x01";
  const std::uint32_t edits = 1 + rng.next_u32() % 4;
  for (std::uint32_t i = 0; i < edits && !bytes.empty(); ++i) {
    const std::size_t at = rng.next_u32() % bytes.size();
    switch (rng.next_u32() % 8) {
      case 0:
        bytes.resize(at);
        break;
      case 1:
        bytes.erase(at, 1 + rng.next_u32() % 8);
        break;
      case 2:
        bytes.insert(at, bytes.substr(at, 1 + rng.next_u32() % 40));
        break;
      case 3:
        bytes[at] = static_cast<char>(rng.next_u32());
        break;
      default:
        bytes[at] = interesting[rng.next_u32() % interesting.size()];
        break;
    }
  }
  return bytes;
}

/// Loads `runs` mutations of `target`, in a copy of its folder's files; `scene` is the file to
/// load.
void fuzz(const std::vector<fs::path>& files, const std::string& target, const std::string& scene,
          int runs) {
  const TemporaryFolder folder;
  for (const fs::path& file : files)
    fs::copy_file(file, folder.path() / file.filename());
  const std::string original = bytes_of(folder.path() / target);
  REQUIRE(error_of(folder.path() / scene).empty());
  int refused = 0;
  for (int run = 0; run < runs; ++run) {
    carlo::Rng rng(1, static_cast<std::uint64_t>(run));
    write_bytes(folder.path() / target, mutated(original, rng));
    const std::string message = error_of(folder.path() / scene);
    refused += message.empty() ? 0 : 1;
    INFO("run " << run << ": " << message);
    bool each = true;
    for (const std::string& line : lines_of(message))
      each = each && line.starts_with(folder.path().string()) &&
             line.find(": error: ") != std::string::npos;
    CHECK(each);
  }
  // Mutations that hit comments, names or digits leave a valid scene; most do not.
  CHECK(refused > runs / 4);
  CHECK(refused < runs);
}

}  // namespace

TEST_CASE("each mistake in a broken scene gives a line with its place and what is wrong",
          "[scene]") {
  const BrokenScenes broken_scenes;
  const fs::path& folder = broken_scenes.folder.path();
  int scenes = 0;
  for (const common_test::TableFile& file : broken_scenes.files) {
    if (file.name.starts_with("parts/")) {
      CHECK(file.mistakes.empty());
      continue;
    }
    ++scenes;
    const std::string message = error_of(folder / file.name);
    const std::vector<std::string> lines = lines_of(message);
    INFO(file.name << ": " << message);
    CHECK_FALSE(lines.empty());
    REQUIRE(lines.size() == file.mistakes.size());
    for (std::size_t i = 0; i < lines.size(); ++i) {
      CHECK(lines[i].starts_with((folder / file.mistakes[i].place).string() + ": error: "));
      CHECK(lines[i].find(file.mistakes[i].phrase) != std::string::npos);
    }
  }
  CHECK(scenes >= 150);
}

TEST_CASE("a scene that is no file is an error", "[scene]") {
  CHECK(error_of(broken / "nowhere.xml").find("nowhere.xml:1:1: error: ") != std::string::npos);
  CHECK(error_of(broken / "nowhere.xml").find("does not exist") != std::string::npos);
  CHECK(error_of(broken).find("is a folder") != std::string::npos);
  CHECK(error_of("/dev/null").find("is not a file") != std::string::npos);
}

TEST_CASE("a missing file is named however deep its folder lies", "[scene]") {
  const TemporaryFolder folder;
  fs::path deep = folder.path();
  for (int level = 0; level < 20; ++level)
    deep /= "a_folder_of_twenty_in_all";
  fs::create_directories(deep);
  const auto names = [&](const std::string& content, const std::string& missing) {
    write_bytes(deep / "scene.xml", "<scene version=\"0.6.0\">" + content + "</scene>");
    return error_of(deep / "scene.xml").find("/" + missing + "\" does not exist") !=
           std::string::npos;
  };
  CHECK(names("<emitter type=\"envmap\"><string name=\"filename\" value=\"sky.exr\"/></emitter>",
              "sky.exr"));
  CHECK(names("<shape type=\"obj\"><string name=\"filename\" value=\"cup.obj\"/></shape>",
              "cup.obj"));
  CHECK(names("<include filename=\"room.xml\"/>", "room.xml"));
}

TEST_CASE("a zero byte is an error at its place", "[scene]") {
  const TemporaryFolder folder;
  write_bytes(folder.path() / "zero.xml", std::string("<scene>\n  \0</scene>", 19));
  CHECK(error_of(folder.path() / "zero.xml").find("zero.xml:2:3: error: ") != std::string::npos);
}

TEST_CASE("a million nested elements are an error, not a crash", "[scene]") {
  const TemporaryFolder folder;
  std::string text;
  for (int i = 0; i < 1'000'000; ++i)
    text += "<a>";
  write_bytes(folder.path() / "open.xml", text);
  CHECK(error_of(folder.path() / "open.xml").find("not well-formed") != std::string::npos);
  for (int i = 0; i < 1'000'000; ++i)
    text += "</a>";
  write_bytes(folder.path() / "deep.xml", text);
  CHECK(error_of(folder.path() / "deep.xml").find("deep.xml:1:49: error: elements are nested") !=
        std::string::npos);
}

TEST_CASE("includes that multiply are cut off", "[scene]") {
  const TemporaryFolder folder;
  for (int level = 0; level < 20; ++level) {
    const std::string next = fmt::format("<include filename=\"s{}.xml\"/>", level + 1);
    write_bytes(folder.path() / fmt::format("s{}.xml", level),
                fmt::format("<scene version=\"0.6.0\">{}{}</scene>", next, next));
  }
  write_bytes(folder.path() / "s20.xml", "<scene version=\"0.6.0\"/>");
  CHECK(error_of(folder.path() / "s0.xml").find("more than 1000 files") != std::string::npos);
}

TEST_CASE("columns count characters, not bytes", "[scene]") {
  const TemporaryFolder folder;
  write_bytes(folder.path() / "utf8.xml",
              "<scene version=\"0.6.0\">\n<!-- \xc3\xa4\xc3\xb6 --><nothing/></scene>");
  CHECK(error_of(folder.path() / "utf8.xml").find("utf8.xml:2:12: error: ") != std::string::npos);
}

TEST_CASE("lines of a file that end in CR alone are counted", "[scene]") {
  const TemporaryFolder folder;
  const auto error = [&](const std::string& text) {
    write_bytes(folder.path() / "mac.xml", text);
    return error_of(folder.path() / "mac.xml");
  };
  CHECK(error("<scene version=\"0.6.0\">\r <!-- -->\r  <nothing/>\r</scene>")
            .find("mac.xml:3:3: error: ") != std::string::npos);
  const std::string open = error("<scene version=\"0.6.0\">\r\r<shape>\r</scene>");
  INFO(open);
  CHECK(open.find("mac.xml:3:1: error: ") != std::string::npos);
  CHECK(open.find("<shape> is not closed before </scene> in line 4") != std::string::npos);
}

TEST_CASE("an override that names no parameter is an error", "[scene]") {
  const fs::path scene = source_dir / "common/scenes/cornell_phong.xml";
  const std::string message = error_of(scene, {{"sppp", "4"}});
  CHECK(message.find("no parameter \"sppp\" (did you mean \"spp\"?)") != std::string::npos);
  CHECK(message.find("cornell_phong.xml:1:1: error: ") != std::string::npos);
  CHECK(error_of(scene, {{"spp", "many"}}).find("got \"many\" (from \"$spp\")") !=
        std::string::npos);
}

TEST_CASE("no mutation of a scene file does worse than an error", "[scene][fuzz]") {
  const fs::path scene = source_dir / "common/scenes/cornell_phong.xml";
  fuzz({scene}, "cornell_phong.xml", "cornell_phong.xml", 1000);
  const fs::path folder = source_dir / "tests/common/scenes";
  fuzz({folder / "every_plugin.xml", folder / "included.xml", folder / "tetrahedron.obj"},
       "every_plugin.xml", "every_plugin.xml", 2000);
}

TEST_CASE("no mutation of a mesh file does worse than an error", "[scene][fuzz]") {
  const fs::path folder = source_dir / "tests/common/scenes";
  const std::vector<fs::path> files = {folder / "meshes.xml", folder / "tetrahedron.obj",
                                       folder / "tetrahedron_ascii.ply",
                                       folder / "tetrahedron_binary.ply"};
  for (const char* target :
       {"tetrahedron.obj", "tetrahedron_ascii.ply", "tetrahedron_binary.ply"}) {
    fuzz(files, target, "meshes.xml", 700);
  }
}
