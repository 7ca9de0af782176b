// Tests which parts of Mitsuba's and Nori's scenes are read: loads each line of the table in
// common/scene/README.md, and checks that the page lists everything that the loader knows.

#include "course/cli/source_folder.h"
#include "scene/fingerprint.h"
#include "scene/names.h"
#include "scene/plugins.h"
#include "scene_helpers.h"
#include "support/atomic_file.h"
#include "support/error.h"

#include <catch2/catch_test_macros.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>
#include <sstream>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace fs = std::filesystem;
using namespace carlo;
using scene_test::load_text;
using scene_test::TemporaryFolder;
using scene_test::write_bytes;

namespace {

const fs::path tree = source_folder();

std::string page() {
  return read_file(tree / "common/scene/README.md");
}

/// A line of the table.
struct Row {
  std::string in, what;               ///< "film hdrfilm", "no effect"
  std::vector<std::string> snippets;  ///< "<boolean .../>"
};

std::string between(const std::string& text, const std::string& open, const std::string& close) {
  const std::size_t begin = text.find(open) + open.size();
  return text.substr(begin, text.find(close, begin) - begin);
}

std::vector<std::string> in_backticks(const std::string& text) {
  std::vector<std::string> out;
  std::size_t open = text.find('`');
  while (open != std::string::npos) {
    const std::size_t close = text.find('`', open + 1);
    REQUIRE(close != std::string::npos);
    out.push_back(text.substr(open + 1, close - open - 1));
    open = text.find('`', close + 1);
  }
  return out;
}

std::vector<Row> rows() {
  std::vector<Row> out;
  std::istringstream lines(between(page(), "| in | example |", "\n## "));
  std::string line;
  std::getline(lines, line), std::getline(lines, line);  // the table's head
  while (std::getline(lines, line) && line.starts_with("| ")) {
    const std::size_t second = line.find(" | "), third = line.find(" | ", second + 3);
    REQUIRE(third != std::string::npos);
    out.push_back({line.substr(2, second - 2), between(line.substr(third), "**", "**"),
                   in_backticks(line.substr(second, third - second))});
  }
  return out;
}

/// A scene whose <element type="..."> called `in` has `snippet` inside.
class Scenery {
 public:
  Scenery(std::string in, std::string snippet) : in_(std::move(in)), snippet_(std::move(snippet)) {}

  std::string text() const {
    const std::string root = in_ == "root" ? snippet_ : "<scene version=\"0.6.0\">";
    const std::string name = root.substr(1, root.find_first_of(" >") - 1);
    return root +
           "<bsdf type=\"diffuse\" id=\"white\"><rgb name=\"reflectance\" value=\".8\"/></bsdf>"
           "<shape type=\"sphere\"><ref id=\"white\"/></shape>" +
           camera() + materials() + shapes() + lights() + (in_ == "scene" ? snippet_ : "") + "</" +
           name + ">";
  }

 private:
  /// An element, with the snippet if it belongs there.
  std::string element(const std::string& name, const std::string& type,
                      const std::string& inside = "", const std::string& more = "") const {
    const bool here = in_ == name + " " + type || (in_ == "any object" && name != "rfilter");
    return "<" + name + " type=\"" + type + "\"" + more + ">" + inside + (here ? snippet_ : "") +
           "</" + name + ">";
  }

  std::string camera() const {
    std::string inside =
        "<float name=\"fov\" value=\"40\"/><transform name=\"toWorld\"><translate z=\"-9\"/>"
        "</transform>";
    const std::string filter = snippet_.starts_with("<rfilter") ? "" : element("rfilter", "box");
    if (in_ != "sensor perspective") {
      inside += element("film", in_ == "film ldrfilm" ? "ldrfilm" : "hdrfilm", filter);
      inside += element("sampler", in_ == "sampler stratified" ? "stratified" : "sobol");
    }
    return element("sensor", "perspective", inside) + element("integrator", "path");
  }

  std::string materials() const {
    const std::string mirror = "<string name=\"material\" value=\"none\"/>";
    std::string out;
    for (const char* type : {"diffuse", "phong", "dielectric", "conductor"}) {
      const bool given =
          std::string(type) != "conductor" ||
          (in_ == "bsdf conductor" && snippet_.find("material") != std::string::npos);
      out += element("bsdf", type, given ? "" : mirror, std::string(" id=\"") + type + "\"") +
             "<shape type=\"sphere\"><ref id=\"" + type + "\"/></shape>";
    }
    return out;
  }

  std::string shapes() const {
    const std::string place = in_ == "transform" ? snippet_ : "";
    std::string out = "<shape type=\"cube\"><transform name=\"toWorld\">" + place +
                      "</transform></shape>" + element("shape", "rectangle");
    for (const char* file : {"tetrahedron.obj", "tetrahedron_ascii.ply"}) {
      const std::string type = fs::path(file).extension().string().substr(1);
      out += element("shape", type,
                     std::string("<boolean name=\"faceNormals\" value=\"true\"/><string "
                                 "name=\"filename\" value=\"") +
                         file + "\"/>");
    }
    return out;
  }

  std::string lights() const {
    if (in_ == "emitter envmap")
      return element("emitter", "envmap", "<string name=\"filename\" value=\"white.hdr\"/>");
    return element("emitter", "constant") + element("emitter", "point");
  }

  std::string in_, snippet_;
};

/// The files that Scenery names.
class Files {
 public:
  Files() {
    for (const char* file : {"tetrahedron.obj", "tetrahedron_ascii.ply"})
      fs::copy_file(tree / "tests/common/scenes" / file, folder_.path() / file);
    write_bytes(
        folder_.path() / "white.hdr",
        "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 2\n\x80\x80\x80\x81\x80\x80\x80\x81");
  }
  Scene load(const std::string& text) const {
    write_bytes(folder_.path() / "scene.xml", text);
    return load_scene(folder_.path() / "scene.xml");
  }
  /// The error message; empty if there is none.
  std::string error(const std::string& text) const {
    try {
      load(text);
    } catch (const PlacedError& error) {
      return error.what();
    }
    return "";
  }

 private:
  TemporaryFolder folder_;
};

/// Loads a scene with the snippet and checks that the result is what the table says.
void check_snippet(const Files& files, const std::string& in, const std::string& snippet,
                   const std::string& what) {
  INFO(in << ": " << snippet << " is said to be: " << what);
  const std::string text = Scenery(in, snippet).text();
  const std::string message = files.error(text);
  INFO(message);
  if (what == "refused") {
    CHECK_FALSE(message.empty());
    CHECK(message.find('\n') == std::string::npos);
    return;
  }
  REQUIRE(message.empty());
  const std::string nothing = in == "root" ? "<scene version=\"0.6.0\">" : "";
  const Scene without = files.load(Scenery(in, nothing).text()), with = files.load(text);
  const bool same = fingerprint(with) == fingerprint(without);
  CHECK(same == (what != "read"));
  CHECK(with.notes.size() == without.notes.size() + (what == "note" ? 1 : 0));
  CHECK((what == "read" || what == "no effect" || what == "note"));
}

/// "int_ior" for "intIOR".
std::string in_small_letters(std::string_view name) {
  const auto is_capital = [](char c) { return c >= 'A' && c <= 'Z'; };
  std::string out;
  for (std::size_t i = 0; i < name.size(); ++i) {
    if (is_capital(name[i]) && !is_capital(name[i - 1])) out += '_';
    out += is_capital(name[i]) ? static_cast<char>(name[i] - 'A' + 'a') : name[i];
  }
  return out;
}

double red(const Scene& scene) {
  return static_cast<double>(scene.lights.environment.r);
}

std::string scene_of(const std::string& version, const std::string& elements) {
  return "<scene version=\"" + version +
         "\"><sensor type=\"perspective\"><float name=\"fov\" value=\"40\"/></sensor>" + elements +
         "</scene>";
}

}  // namespace

TEST_CASE("each line of the page's table is what the loader does", "[scene]") {
  const Files files;
  const std::vector<Row> table = rows();
  CHECK(table.size() >= 25);
  for (const Row& row : table) {
    CHECK_FALSE(row.snippets.empty());
    for (const std::string& snippet : row.snippets)
      check_snippet(files, row.in, snippet, row.what);
  }
}

TEST_CASE("what the loader knows stands on the page", "[scene]") {
  const std::string text = page();
  const std::vector<Row> table = rows();
  const auto in_table = [&](const Plugin& plugin, std::string_view property) {
    const std::string given = "name=\"" + std::string(property) + "\"";
    return std::any_of(table.begin(), table.end(), [&](const Row& row) {
      return row.in.starts_with(plugin.element) &&
             std::any_of(row.snippets.begin(), row.snippets.end(),
                         [&](const std::string& s) { return s.find(given) != std::string::npos; });
    });
  };
  for (const Plugin& plugin : plugins()) {
    INFO(plugin.element << " " << plugin.type);
    const std::string type(plugin.type);
    CHECK((text.find("`" + type + "`") != std::string::npos ||
           text.find("type=\"" + type + "\"") != std::string::npos));
    for (const Rule& rule : plugin.rules) {
      INFO(rule.name);
      if (rule.treatment == Treatment::read)
        CHECK((text.find("`" + std::string(rule.name) + "`") != std::string::npos ||
               text.find("name=\"" + std::string(rule.name) + "\"") != std::string::npos));
      else
        CHECK(in_table(plugin, rule.name));
    }
  }
}

TEST_CASE("a name of Mitsuba 3 is the property that it names, in every file", "[scene]") {
  std::set<std::string_view> known;
  for (const Plugin& plugin : plugins()) {
    for (const Rule& rule : plugin.rules)
      known.insert(rule.name);
  }
  for (const Name& name : property_names) {
    INFO(name.mitsuba06);
    CHECK(known.count(name.mitsuba06) == 1);
    CHECK(known.count(name.mitsuba3) == 0);
    CHECK(in_small_letters(name.mitsuba06) == name.mitsuba3);
  }
  const std::string old_names =
      "<scene version=\"VERSION\"><integrator type=\"path\"><integer name=\"maxDepth\" value=\"3\"/>"
      "</integrator><sensor type=\"perspective\"><float name=\"fov\" value=\"40\"/><string "
      "name=\"fovAxis\" value=\"y\"/><transform name=\"toWorld\"><lookat origin=\"1 2 6\" target=\"0 "
      "0 0\"/></transform></sensor><shape type=\"disk\"><boolean name=\"flipNormals\" "
      "value=\"true\"/><bsdf type=\"dielectric\"><float name=\"intIOR\" value=\"1.3\"/><string "
      "name=\"extIOR\" value=\"vacuum\"/></bsdf></shape></scene>";
  std::string new_names = old_names;
  for (const Name& name : property_names) {
    const std::string from = "\"" + std::string(name.mitsuba06) + "\"";
    const std::size_t at = new_names.find(from);
    if (at != std::string::npos)
      new_names.replace(at, from.size(), "\"" + std::string(name.mitsuba3) + "\"");
  }
  CHECK(new_names.find("max_depth") != std::string::npos);
  const auto of_version = [](std::string text, const std::string& version) {
    return text.replace(text.find("VERSION"), 7, version);
  };
  const std::string expected = fingerprint(load_text(of_version(old_names, "0.6.0")));
  for (const char* version : {"0.5.0", "0.6.0", "2.2.1", "3.0.0", "3.9.1"}) {
    CHECK(fingerprint(load_text(of_version(old_names, version))) == expected);
    CHECK(fingerprint(load_text(of_version(new_names, version))) == expected);
  }
}

TEST_CASE("a light without radiance has Mitsuba's default, 1", "[scene]") {
  const Scene scene =
      load_text(scene_of("0.6.0",
                         "<emitter type=\"constant\"/><emitter type=\"point\"/><shape "
                         "type=\"sphere\"><emitter type=\"area\"/></shape>"));
  CHECK(scene.lights.environment == Rgb(1));
  CHECK(scene.lights.points.at(0).intensity == Rgb(1));
  CHECK(scene.shapes.at(0).radiance == Rgb(1));
}

TEST_CASE("the spectrum of one number in an emitter is white in 0.6, not in 3", "[scene]") {
  const std::string sky =
      "<emitter type=\"constant\"><spectrum name=\"radiance\" value=\"0.5\"/></emitter>";
  const Scene old_scene = load_text(scene_of("0.6.0", sky));
  CHECK(old_scene.lights.environment == Rgb(0.5f));
  CHECK(old_scene.notes.empty());
  // As rendered by Mitsuba 3.9.1.
  const Scene scene = load_text(scene_of("3.0.0", sky));
  CHECK(
      scene_test::close(scene.lights.environment, Rgb(0.6023975f, 0.47414577f, 0.4544582f), 5e-5f));
  CHECK(scene.notes.size() == 1);
  // For a surface it is grey in both.
  const Scene grey = load_text(scene_of(
      "3.0.0",
      "<emitter type=\"constant\"/><shape type=\"sphere\"><bsdf type=\"diffuse\"><spectrum "
      "name=\"reflectance\" value=\"0.7\"/></bsdf></shape>"));
  CHECK(std::get<Diffuse>(grey.materials.at(0).model).reflectance == Rgb(0.7f));
}

TEST_CASE("a conductor without material is a mirror in 3, copper in 0.6", "[scene]") {
  const std::string shape =
      "<emitter type=\"constant\"/><shape type=\"sphere\"><bsdf type=\"conductor\"/></shape>";
  const Scene scene = load_text(scene_of("3.0.0", shape));
  CHECK(std::get<Mirror>(scene.materials.at(0).model).reflectance == Rgb(1));
  CHECK_THROWS_AS(load_text(scene_of("0.6.0", shape)), PlacedError);
}

TEST_CASE("a mirrored sphere is turned inside out in 3, not in 0.6", "[scene]") {
  const auto flipped = [](const std::string& version, const std::string& more,
                          const std::string& steps = "<scale x=\"-1\"/>") {
    const Scene scene =
        load_text(scene_of(version, "<shape type=\"sphere\"><transform name=\"toWorld\">" + steps +
                                        "</transform>" + more + "</shape>"));
    return std::get<Sphere>(scene.shapes.at(0).geometry).flipped;
  };
  const std::string flip = "<boolean name=\"flipNormals\" value=\"true\"/>";
  CHECK_FALSE(flipped("0.6.0", ""));
  CHECK(flipped("0.6.0", flip));
  CHECK(flipped("3.0.0", ""));
  CHECK_FALSE(flipped("3.0.0", flip));
  // Three reflections are one; two are a rotation.
  CHECK(flipped("3.0.0", "", "<scale value=\"-2\"/>"));
  CHECK_FALSE(flipped("3.0.0", "", "<scale x=\"-1\" y=\"-1\"/>"));
}

TEST_CASE("an srgb colour is decoded by sRGB's curve", "[scene]") {
  const auto sky = [](const std::string& value) {
    return red(
        load_text(scene_of("0.6.0", "<emitter type=\"constant\"><srgb name=\"radiance\" value=\"" +
                                        value + "\"/></emitter>")));
  };
  CHECK(sky("1") == Catch::Approx(1));
  CHECK(sky("#ff0000") == Catch::Approx(1));
  CHECK(sky("#bc0000") == Catch::Approx(std::pow((188 / 255.0 + .055) / 1.055, 2.4)));
  CHECK(sky("0.5, 0, 0") == Catch::Approx(std::pow((.5 + .055) / 1.055, 2.4)));
  CHECK(sky("0.03") == Catch::Approx(.03 / 12.92));
}
