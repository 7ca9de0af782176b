#include "scene/load_scene.h"

#include "scene/center.h"
#include "scene/digits.h"
#include "scene/duplicates.h"
#include "scene/envmap_file.h"
#include "scene/grammar.h"
#include "scene/materials.h"
#include "scene/names.h"
#include "scene/parameters.h"
#include "scene/properties.h"
#include "scene/sensor.h"
#include "scene/shapes.h"
#include "scene/text.h"
#include "scene/transforms.h"
#include "scene/values.h"
#include "scene/xml_source.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <memory>
#include <optional>

namespace carlo {
namespace {

namespace fs = std::filesystem;

/// An element that identifies a Nori scene: cameras and meshes have names of their own there, and
/// the root has no version.
const XmlElement* nori_element(const XmlElement& root) {
  constexpr std::array names = {"camera", "mesh", "test"};
  const auto is_nori = [&](const XmlElement& child) {
    return std::find(names.begin(), names.end(), child.name) != names.end();
  };
  if (root.name == "test") return &root;
  const auto found = std::find_if(root.children.begin(), root.children.end(), is_nori);
  return root.find("version") != nullptr || found == root.children.end() ? nullptr : &*found;
}

/// Throws Error at a root element that is not a Mitsuba scene, such as one of Nori.
void check_root(const XmlElement& root, SceneErrors& errors) {
  if (const XmlElement* nori = nori_element(root)) {
    fail(
        nori->at,
        "<{}> is of Nori's scene format, which is not read: Mitsuba's has <scene version=\"0.6.0\">, "
        "<sensor> for <camera>, <shape> for <mesh>, <rgb> for <color>",
        nori->name);
  }
  if (root.name != "scene") {
    fail(root.at, "the root element is <{}>, expected <scene>", root.name);
  }
  root.allow_only({"version"}, errors);
}

/// The dialect according to the attribute `version`. Throws Error at an unsupported version, or at
/// the element.
Dialect dialect(const XmlElement& root) {
  const XmlAttribute& version = root.get("version");
  const auto known = dialect_of(version.value);
  if (!known) {
    fail(version.value_at, "scene version {} is not supported, expected 0.5.x, 0.6.x, 2.x or 3.x",
         in_quotes(version.value));
  }
  return *known;
}

constexpr std::size_t most_files = 1000;  // includes of includes multiply

class Loader {
 public:
  /// `center`: the point of the file's world that is the scene's origin.
  Loader(const std::map<std::string, std::string>& parameters, glm::dvec3 center)
      : center_(center), parameters_(parameters) {}

  Scene load(const fs::path& path) {
    load_file(path, {});
    const Position start{sources_.front().get(), 0};
    if (!errors_.names_lost()) {
      parameters_.check_overrides(start, errors_);
      if (sensor_ == nullptr) errors_.guard([&] { fail(start, "the scene has no <sensor>"); });
    }
    errors_.raise();
    check_clip(scene_, clip_, errors_);
    errors_.raise();
    scene_.materials = materials_.list();
    leave_out_duplicate_lights(scene_, start);
    mark_back_to_back(scene_);
    add_notes();
    return std::move(scene_);
  }

 private:
  /// Errors inside the file are collected. Throws Error if it is not a scene file at all.
  void load_file(const fs::path& path, Position asked_at) {
    if (sources_.size() >= most_files) fail(asked_at, "more than {} files included", most_files);
    sources_.push_back(read_xml_source(path, asked_at));
    XmlSource& source = *sources_.back();
    errors_.reads(path.string());
    const fs::path canonical = fs::canonical(path);
    if (std::find(open_.begin(), open_.end(), canonical) != open_.end()) {
      fail(asked_at, "{} includes itself", path_in_quotes(path));
    }
    XmlElement root = parse_xml(source, errors_);
    check_root(root, errors_);
    errors_.guard([&] { source.dialect = dialect(root); });
    open_.push_back(canonical);
    for (XmlElement& child : root.children)
      errors_.guard([&] { load_element(child); });
    open_.pop_back();
  }

  void load_element(XmlElement& element) {
    parameters_.substitute(element, errors_);
    if (element.name == "default") return parameters_.declare(element, errors_);
    if (element.name == "include") return include(element);
    ids_.declare(element, errors_);
    check_supported(element);
    check_object(element, "scene", errors_, scene_.notes);
    if (element.name == "bsdf") return materials_.define(element);
    if (element.name == "shape") return add_shape(element);
    if (element.name == "emitter") return add_emitter(element);
    const bool is_sensor = element.name == "sensor";
    once(is_sensor ? sensor_ : integrator_, element);
    if (is_sensor)
      clip_ = parse_sensor(element, scene_, center_, errors_);
    else if (!element.broken)
      parse_integrator(element, scene_);
  }

  void check_supported(const XmlElement& element) {
    const std::vector<std::string> known = {"default", "include", "integrator", "sensor",
                                            "bsdf",    "shape",   "emitter"};
    if (std::find(known.begin(), known.end(), element.name) != known.end()) return;
    const auto meant = [&](const std::string& name) { return is_near(element.name, name); };
    if (std::any_of(known.begin(), known.end(), meant)) errors_.lose_names();
    fail(element.at, "<{}> is not supported here{}", element.name, suggest(element.name, known));
  }

  void include(const XmlElement& element) {
    element.allow_only({"filename"}, errors_);
    element.allow_nothing_inside(errors_);
    if (errors_.guard([&] { include_file(element); })) return;
    errors_.lose_names();
  }

  void include_file(const XmlElement& element) {
    const XmlAttribute& filename = element.get("filename");
    if (element.broken) return errors_.lose_names();
    load_file(find_file(element.at, filename.value), filename.value_at);
  }

  static void once(const XmlSource*& seen, const XmlElement& element) {
    if (seen != nullptr) {
      const XmlAttribute& type = element.get("type");
      fail(element.at, "a second <{} type={}>, expected one", element.name, in_quotes(type.value));
    }
    seen = element.at.source;
  }

  void add_shape(const XmlElement& element) {
    Properties shape(element, center_);
    std::vector<Geometry> geometry;
    if (!element.broken) {
      errors_.guard([&] {
        geometry = parse_geometry(shape, scene_.notes, errors_);
        shape.finish();
      });
    }
    const XmlElement* emitter = shape.object("emitter");
    const Rgb radiance = emitter != nullptr && !emitter->broken ? area_radiance(*emitter) : Rgb(0);
    const std::uint32_t material = materials_.of_shape(shape, emitter != nullptr);
    for (Geometry& item : geometry)
      scene_.shapes.push_back({std::move(item), material, radiance});
  }

  Rgb area_radiance(const XmlElement& element) {
    Properties emitter(element);
    return emission(emitter, "radiance");
  }

  void add_emitter(const XmlElement& element) {
    Properties emitter(element, center_);
    const std::string type = element.find("type") != nullptr ? emitter.type() : "";
    if (type == "constant" || type == "envmap") once(environment_, element);
    if (element.broken) return;
    if (type == "point") return add_point_light(emitter);
    if (type == "envmap")
      scene_.lights.envmap = parse_envmap(emitter, scene_.notes);
    else
      scene_.lights.environment = emission(emitter, "radiance");
  }

  void add_point_light(Properties& emitter) {
    const bool both = emitter.has("position") && emitter.has("toWorld");
    if (both) fail(emitter.at("toWorld"), "a point light has a position or a toWorld, got both");
    const glm::dvec3 position = emitter.point("position").value_or(glm::dvec3(0));
    const glm::dmat4 to_world = emitter.to_world();
    PointLight light;
    light.position = transform_point(to_world, position, emitter.at("toWorld"));
    light.intensity = emission(emitter, "intensity");
    scene_.lights.points.push_back(light);
  }

  /// 1 if the emitter does not give it, as in Mitsuba.
  Rgb emission(Properties& emitter, const std::string& name) {
    const XmlElement* given = emitter.take(name);
    if (given != nullptr && is_equal_energy(*given)) {
      const std::string note =
          "a <spectrum> of one number shines with the same energy at each wavelength, as in Mitsuba "
          "3: not white, but (1.205, 0.948, 0.909) times it";
      auto& notes = scene_.notes;
      if (std::find(notes.begin(), notes.end(), note) == notes.end()) notes.push_back(note);
    }
    const Rgb colour = emitter.emission(name).value_or(Rgb(1));
    emitter.finish();
    return colour;
  }

  void add_notes() {
    for (const std::string& note : materials_.notes())
      scene_.notes.push_back(note);
    const auto emits = [](const Shape& shape) { return shape.emits(); };
    const auto& [points, environment, envmap] = scene_.lights;
    const bool lit = std::any_of(scene_.shapes.begin(), scene_.shapes.end(), emits) ||
                     !points.empty() || environment != Rgb(0) || envmap;
    if (!lit) scene_.notes.emplace_back("the scene has no light: its image is black");
  }

  Scene scene_;
  glm::dvec3 center_;
  Parameters parameters_;
  Ids ids_;
  SceneErrors errors_;
  Materials materials_{ids_, errors_};
  ClipRange clip_;
  std::vector<std::unique_ptr<XmlSource>> sources_;  // errors point into them
  std::vector<fs::path> open_;                       // the files being read, outermost first
  const XmlSource* sensor_ = nullptr;                // the file with the sensor, once one is found
  const XmlSource* integrator_ = nullptr;
  const XmlSource* environment_ = nullptr;
};

void add_note(Scene& scene, const std::optional<std::string>& note) {
  if (note) scene.notes.push_back(*note);
}

}  // namespace

Scene load_scene(const fs::path& path, const std::map<std::string, std::string>& parameters) {
  Scene scene = Loader(parameters, glm::dvec3(0)).load(path);
  const auto center = far_center(scene);
  if (!center) {
    add_note(scene, too_few_digits(scene));
    return scene;
  }
  // Loads it again, since rounding has already taken digits from the coordinates.
  Scene moved = Loader(parameters, *center).load(path);
  moved.notes.push_back(fmt::format(
      "the scene lies around ({:g}, {:g}, {:g}), far from the origin for its size: it is rendered "
      "around (0, 0, 0), where coordinates have more digits",
      center->x, center->y, center->z));
  add_note(moved, too_few_digits(moved));
  return moved;
}

}  // namespace carlo
