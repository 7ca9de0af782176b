#include "scene/sensor.h"

#include "image/image.h"
#include "scene/properties.h"
#include "scene/sampler_kind.h"
#include "scene/text.h"
#include "scene/transforms.h"

#include <cmath>

namespace carlo {
namespace {

void require_type(const Properties& object, std::string_view kind,
                  const std::vector<std::string>& types) {
  for (const std::string& type : types) {
    if (object.type() == type) return;
  }
  fail(object.type_at(), "{} {} is not supported{}", kind, in_quotes(object.type()),
       suggest(object.type(), types));
}

void parse_film(const XmlElement& element, Scene& scene) {
  Properties film(element, {"rfilter"});
  require_type(film, "film", {"hdrfilm"});
  scene.width = film.integer("width").value_or(768);
  scene.height = film.integer("height").value_or(576);
  film.finish();
  for (const char* side : {"width", "height"}) {
    const int pixels = *side == 'w' ? scene.width : scene.height;
    if (pixels < 1) fail(film.at(side), "{} must be >= 1, got {}", side, pixels);
  }
  if (std::int64_t{scene.width} * scene.height > most_pixels) {
    fail(film.at("width"), "the film is too large: {} x {} pixels, at most {} are supported",
         scene.width, scene.height, most_pixels);
  }
  if (const XmlElement* filter = film.object("rfilter")) {
    const Properties properties(*filter);
    require_type(properties, "rfilter", {"box"});
    properties.finish();
  }
}

void parse_sampler(const XmlElement& element, Scene& scene) {
  Properties sampler(element);
  require_type(sampler, "sampler", sampler_names());
  scene.sampler = sampler_kind(sampler.type());
  scene.spp = sampler.integer("sampleCount").value_or(scene.spp);
  sampler.finish();
  if (scene.spp < 1) {
    fail(sampler.at("sampleCount"), "sampleCount must be >= 1, got {}", scene.spp);
  }
}

FovAxis parse_axis(const std::string& axis, Position at) {
  if (axis == "x") return FovAxis::x;
  if (axis == "y") return FovAxis::y;
  if (axis == "smaller") return FovAxis::smaller;
  if (axis == "larger") return FovAxis::larger;
  fail(at, "fovAxis {} is not supported{}", in_quotes(axis),
       suggest(axis, {"x", "y", "smaller", "larger"}));
}

void set_field_of_view(Properties& sensor, Scene& scene) {
  const auto fov = sensor.number("fov");
  if (!fov) sensor.missing("fov", "float");
  const double tangent = std::tan(glm::radians(static_cast<double>(*fov)) / 2);
  const auto tan_half = static_cast<float>(tangent);
  if (!(*fov > 0 && *fov < 180 && tan_half > 0)) {
    fail(sensor.at("fov"), "fov must be within (0, 180) degrees, got {}", *fov);
  }
  const std::string axis = sensor.string("fovAxis").value_or("x");
  scene.camera.fov_axis = parse_axis(axis, sensor.at("fovAxis"));
  scene.camera.tan_half_fov = tan_half;
  scene.camera.fit_film(scene.width, scene.height);
}

// Mitsuba's camera looks along +z; its +x points to the left of the image.
void set_frame(Properties& sensor, Camera& camera) {
  const glm::dmat4 to_world = sensor.to_world();
  const Position at = sensor.at("toWorld");
  const glm::dvec3 x(to_world[0]), y(to_world[1]), z(to_world[2]);
  if (!equal_and_orthogonal(x, y) || !equal_and_orthogonal(y, z) || !equal_and_orthogonal(z, x) ||
      !(std::abs(glm::length(z) - 1) < 1e-3)) {
    fail(at, "the camera's toWorld must not scale or shear");
  }
  // Gram and Schmidt take out what rounding in the file has left.
  const glm::dvec3 forward = glm::normalize(z);
  const glm::dvec3 up = glm::normalize(y - glm::dot(y, forward) * forward);
  const glm::dvec3 left = glm::cross(up, forward) * (mirrors(to_world) ? -1.0 : 1.0);
  camera.forward = Vec3(forward);
  camera.up = Vec3(up);
  camera.right = Vec3(-left);
  camera.origin = transform_point(to_world, glm::dvec3(0), at);
}

}  // namespace

void parse_sensor(const XmlElement& element, Scene& scene, glm::dvec3 center) {
  Properties sensor(element, {"film", "sampler"}, center);
  require_type(sensor, "sensor", {"perspective"});
  scene.width = 768;
  scene.height = 576;
  if (const XmlElement* film = sensor.object("film")) parse_film(*film, scene);
  if (const XmlElement* sampler = sensor.object("sampler")) parse_sampler(*sampler, scene);
  set_field_of_view(sensor, scene);
  set_frame(sensor, scene.camera);
  sensor.finish();
}

void parse_integrator(const XmlElement& element, Scene& scene) {
  Properties integrator(element);
  require_type(integrator, "integrator", {"path"});
  const int depth = integrator.integer("maxDepth").value_or(-1);
  integrator.finish();
  if (depth < -1 || depth == 0) {
    fail(integrator.at("maxDepth"), "maxDepth must be >= 1, or -1 for no limit, got {}", depth);
  }
  scene.max_depth = depth == -1 ? 0 : depth;
}

}  // namespace carlo
