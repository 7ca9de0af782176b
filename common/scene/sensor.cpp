#include "scene/sensor.h"

#include "image/image.h"
#include "scene/properties.h"
#include "scene/sampler_kind.h"
#include "scene/transforms.h"
#include "scene/values.h"

#include <cmath>

namespace carlo {
namespace {

void check_crop(Properties& film, const std::string& name, int side, SceneErrors& errors) {
  const int crop = film.integer(name).value_or(side);
  if (crop == side) return;
  errors.guard([&] {
    fail(film.at(name), "{} must be the film's {}, got {}: images are rendered whole", name, side,
         crop);
  });
}

void parse_film(const XmlElement& element, Scene& scene, SceneErrors& errors) {
  Properties film(element);
  scene.width = film.integer("width").value_or(scene.width);
  scene.height = film.integer("height").value_or(scene.height);
  film.finish();
  check_crop(film, "cropWidth", scene.width, errors);
  check_crop(film, "cropHeight", scene.height, errors);
  if (std::int64_t{scene.width} * scene.height > most_pixels) {
    fail(film.at("width"), "the film is too large: {} x {} pixels, at most {} are supported",
         scene.width, scene.height, most_pixels);
  }
  if (film.object("rfilter") == nullptr) {
    scene.notes.emplace_back(
        "the film has no <rfilter>: pixels are averaged over their squares (\"box\"), where Mitsuba "
        "has a Gaussian");
  }
}

void parse_sampler(const XmlElement& element, Scene& scene) {
  Properties sampler(element);
  scene.sampler = sampler_kind(sampler.type());
  scene.spp = sampler.integer("sampleCount").value_or(scene.spp);
  sampler.finish();
}

void set_field_of_view(Properties& sensor, Scene& scene) {
  const auto fov = static_cast<double>(sensor.number("fov").value());
  if (const XmlElement* axis = sensor.take("fovAxis"))
    scene.camera.fov_axis = fov_axis_value(*axis);
  scene.camera.tan_half_fov = static_cast<float>(std::tan(glm::radians(fov) / 2));
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
  // Gram-Schmidt removes the rounding errors of the file.
  const glm::dvec3 forward = glm::normalize(z);
  const glm::dvec3 up = glm::normalize(y - glm::dot(y, forward) * forward);
  const glm::dvec3 left = glm::cross(up, forward) * (mirrors(to_world) ? -1.0 : 1.0);
  camera.forward = Vec3(forward);
  camera.up = Vec3(up);
  camera.right = Vec3(-left);
  camera.origin = transform_point(to_world, glm::dvec3(0), at);
}

}  // namespace

ClipRange parse_sensor(const XmlElement& element, Scene& scene, glm::dvec3 center,
                       SceneErrors& errors) {
  Properties sensor(element, center);
  scene.width = 768;
  scene.height = 576;
  const XmlElement* film = sensor.object("film");
  if (film != nullptr && !film->broken) errors.guard([&] { parse_film(*film, scene, errors); });
  const XmlElement* sampler = sensor.object("sampler");
  if (sampler != nullptr && !sampler->broken) errors.guard([&] { parse_sampler(*sampler, scene); });
  if (element.broken) return {};
  set_field_of_view(sensor, scene);
  set_frame(sensor, scene.camera);
  const ClipRange clip{sensor.number("nearClip"), sensor.number("farClip"), sensor.at("nearClip"),
                       sensor.at("farClip")};
  sensor.finish();
  return clip;
}

void parse_integrator(const XmlElement& element, Scene& scene) {
  Properties integrator(element);
  const int depth = integrator.integer("maxDepth").value_or(-1);
  integrator.finish();
  scene.max_depth = depth == -1 ? 0 : depth;
}

}  // namespace carlo
