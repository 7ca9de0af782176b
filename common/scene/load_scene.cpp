#include "scene/load_scene.h"

#include "scene/center.h"
#include "scene/digits.h"
#include "scene/duplicate_lamps.h"
#include "scene/envmap_file.h"
#include "scene/ids.h"
#include "scene/materials.h"
#include "scene/parameters.h"
#include "scene/properties.h"
#include "scene/sensor.h"
#include "scene/shapes.h"
#include "scene/text.h"
#include "scene/transforms.h"
#include "scene/xml_source.h"

#include <fmt/core.h>

#include <algorithm>
#include <limits>
#include <memory>
#include <optional>

namespace carlo {
namespace {

namespace fs = std::filesystem;

constexpr float any = std::numeric_limits<float>::max();
constexpr std::size_t most_files = 1000;  // includes of includes multiply

class Loader {
 public:
  /// `center`: the point of the file's world that is the scene's origin.
  Loader(const std::map<std::string, std::string>& parameters, glm::dvec3 center)
      : center_(center), parameters_(parameters) {}

  Scene load(const fs::path& path) {
    load_file(path, {});
    const Position start{sources_.front().get(), 0};
    parameters_.check_overrides(start);
    if (sensor_ == nullptr) fail(start, "the scene has no <sensor>");
    scene_.materials = materials_.list();
    leave_out_duplicate_lamps(scene_, start);
    add_notes();
    return std::move(scene_);
  }

 private:
  void load_file(const fs::path& path, Position asked_at) {
    if (sources_.size() >= most_files) fail(asked_at, "more than {} files included", most_files);
    sources_.push_back(read_xml_source(path, asked_at));
    const fs::path canonical = fs::canonical(path);
    if (std::find(open_.begin(), open_.end(), canonical) != open_.end()) {
      fail(asked_at, "{} includes itself", path_in_quotes(path));
    }
    open_.push_back(canonical);
    XmlElement root = parse_xml(*sources_.back());
    check_root(root);
    for (XmlElement& child : root.children)
      load_element(child);
    open_.pop_back();
  }

  static void check_root(const XmlElement& root) {
    if (root.name != "scene") {
      fail(root.at, "the root element is <{}>, expected <scene>", root.name);
    }
    root.allow_only({"version"});
    const XmlAttribute& version = root.get("version");
    if (version.value.rfind("0.5.", 0) != 0 && version.value.rfind("0.6.", 0) != 0) {
      fail(version.value_at, "scene version {} is not supported, expected 0.6.0 (or 0.5.x)",
           in_quotes(version.value));
    }
  }

  void load_element(XmlElement& element) {
    parameters_.substitute(element);
    if (element.name == "default") return parameters_.declare(element);
    if (element.name == "include") return include(element);
    ids_.declare(element);
    if (element.name == "bsdf") return materials_.define(element);
    if (element.name == "shape") return add_shape(element);
    if (element.name == "emitter") return add_emitter(element);
    if (element.name == "sensor") {
      once(sensor_, element);
      return parse_sensor(element, scene_, center_);
    }
    if (element.name == "integrator") {
      once(integrator_, element);
      return parse_integrator(element, scene_);
    }
    fail(element.at, "<{}> is not supported here{}", element.name,
         suggest(element.name,
                 {"default", "include", "integrator", "sensor", "bsdf", "shape", "emitter"}));
  }

  void include(const XmlElement& element) {
    element.allow_only({"filename"});
    if (!element.children.empty()) {
      fail(element.children.front().at, "<include> takes no elements inside");
    }
    const XmlAttribute& filename = element.get("filename");
    load_file(element.at.source->path.parent_path() / filename.value, filename.value_at);
  }

  static void once(const XmlSource*& seen, const XmlElement& element) {
    if (seen != nullptr) {
      const XmlAttribute& type = element.get("type");
      fail(element.at, "a second <{} type={}>, expected one", element.name, in_quotes(type.value));
    }
    seen = element.at.source;
  }

  void add_shape(const XmlElement& element) {
    Properties shape(element, objects_inside(element.get("type").value), center_);
    std::vector<Geometry> geometry = parse_geometry(shape, scene_.notes);
    shape.finish();
    const XmlElement* emitter = shape.object("emitter");
    const Rgb radiance = emitter != nullptr ? area_radiance(*emitter) : Rgb(0);
    const std::uint32_t material = materials_.of_shape(shape, emitter != nullptr);
    for (Geometry& item : geometry)
      scene_.shapes.push_back({std::move(item), material, radiance});
  }

  Rgb area_radiance(const XmlElement& element) {
    Properties emitter(element);
    if (emitter.type() != "area") {
      fail(emitter.type_at(), "emitter {} cannot stand inside a <shape>, expected \"area\"",
           in_quotes(emitter.type()));
    }
    return required_colour(emitter, "radiance");
  }

  void add_emitter(const XmlElement& element) {
    Properties emitter(element, {}, center_);
    const std::string& type = emitter.type();
    if (type == "point") return add_point_light(emitter);
    if (type != "constant" && type != "envmap") {
      fail(emitter.type_at(), "emitter {} is not supported outside a <shape>{}", in_quotes(type),
           suggest(type, {"point", "constant", "envmap"}));
    }
    once(environment_, element);
    if (type == "envmap")
      scene_.lights.envmap = parse_envmap(emitter, scene_.notes);
    else
      scene_.lights.environment = required_colour(emitter, "radiance");
  }

  void add_point_light(Properties& emitter) {
    const bool both = emitter.has("position") && emitter.has("toWorld");
    if (both) fail(emitter.at("toWorld"), "a point light has a position or a toWorld, got both");
    const glm::dvec3 position = emitter.point("position").value_or(glm::dvec3(0));
    const glm::dmat4 to_world = emitter.to_world();
    PointLight light;
    light.position = transform_point(to_world, position, emitter.at("toWorld"));
    light.intensity = required_colour(emitter, "intensity");
    scene_.lights.points.push_back(light);
  }

  static Rgb required_colour(Properties& emitter, const std::string& name) {
    const auto colour = emitter.colour(name, any);
    if (!colour) emitter.missing(name, "rgb");
    emitter.finish();
    return *colour;
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
  Materials materials_{ids_};
  std::vector<std::unique_ptr<XmlSource>> sources_;  // errors point into them
  std::vector<fs::path> open_;                       // the files being read, outermost first
  const XmlSource* sensor_ = nullptr;                // the file that has it, once there is one
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
  // Once more, since what rounding took from the coordinates is lost.
  Scene moved = Loader(parameters, *center).load(path);
  moved.notes.push_back(fmt::format(
      "the scene lies around ({:g}, {:g}, {:g}), far from the origin for its size: it is rendered "
      "around (0, 0, 0), where coordinates have more digits",
      center->x, center->y, center->z));
  add_note(moved, too_few_digits(moved));
  return moved;
}

}  // namespace carlo
