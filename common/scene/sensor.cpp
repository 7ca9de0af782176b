#include "scene/sensor.h"

#include "image/image.h"
#include "scene/match.h"
#include "scene/properties.h"
#include "scene/sampler_kind.h"
#include "scene/transforms.h"
#include "scene/values.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

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

namespace {

using Vec3d = glm::dvec3;

/// The distance of p from a triangle: from its plane above its inside, otherwise from its edges.
double to_triangle(Vec3d p, const std::array<Vec3d, 3>& corner) {
  const Vec3d normal = glm::cross(corner[1] - corner[0], corner[2] - corner[0]);
  double nearest = std::numeric_limits<double>::infinity();
  bool inside = true;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3d a = corner[i], edge = corner[(i + 1) % 3] - a;
    inside = inside && glm::dot(glm::cross(edge, p - a), normal) >= 0;
    const double t = std::clamp(glm::dot(p - a, edge) / glm::dot(edge, edge), 0.0, 1.0);
    nearest = std::min(nearest, glm::length(p - a - t * edge));
  }
  return inside ? std::abs(glm::dot(p - corner[0], normal)) / glm::length(normal) : nearest;
}

double to_parallelogram(Vec3d p, const Parallelogram& s) {
  const Vec3d o(s.origin), u(s.u), v(s.v);
  return std::min(to_triangle(p, {o, o + u, o + v}), to_triangle(p, {o + u + v, o + v, o + u}));
}

double to_disk(Vec3d p, const Disk& s) {
  const Vec3d n(s.normal), d = p - Vec3d(s.center);
  const double above = glm::dot(d, n), across = glm::length(d - above * n);
  return std::hypot(above, std::max(across - static_cast<double>(s.radius), 0.0));
}

double to_mesh(Vec3d p, const Mesh& s) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const glm::uvec3& t : s.triangles) {
    nearest = std::min(nearest, to_triangle(p, {Vec3d(s.positions[t.x]), Vec3d(s.positions[t.y]),
                                                Vec3d(s.positions[t.z])}));
  }
  return nearest;
}

/// A lower bound on the distance of the nearest surface from p.
double clearance(Vec3d p, const Shape& shape) {
  return match(
      shape.geometry, [&](const Parallelogram& s) { return to_parallelogram(p, s); },
      [&](const Sphere& s) {
        return std::abs(glm::length(p - Vec3d(s.center)) - static_cast<double>(s.radius));
      },
      [&](const Disk& s) { return to_disk(p, s); }, [&](const Mesh& s) { return to_mesh(p, s); },
      [&](const Sdf& s) { return std::abs(sdf::distance(s, p)); });
}

/// An upper bound on how far a shape reaches along `forward` from p.
double reach(Vec3d p, Vec3d forward, const Shape& shape) {
  const auto depth = [&](Vec3d q) { return glm::dot(q - p, forward); };
  return match(
      shape.geometry,
      [&](const Parallelogram& s) {
        const Vec3d o(s.origin), u(s.u), v(s.v);
        return std::max({depth(o), depth(o + u), depth(o + v), depth(o + u + v)});
      },
      [&](const Sphere& s) { return depth(Vec3d(s.center)) + static_cast<double>(s.radius); },
      [&](const Disk& s) {
        const double across = glm::length(glm::cross(forward, Vec3d(s.normal)));
        return depth(Vec3d(s.center)) + static_cast<double>(s.radius) * across;
      },
      [&](const Mesh& s) {
        double most = -std::numeric_limits<double>::infinity();
        for (const glm::uvec3& t : s.triangles) {
          for (const unsigned i : {t.x, t.y, t.z})
            most = std::max(most, depth(Vec3d(s.positions[i])));
        }
        return most;
      },
      [&](const Sdf& s) {
        const sdf::Box box = sdf::bounds(s, s.place);
        return depth(0.5 * (box.lower + box.upper)) +
               0.5 * glm::dot(box.upper - box.lower, glm::abs(forward));
      });
}

}  // namespace

void check_clip(const Scene& scene, const ClipRange& clip, SceneErrors& errors) {
  const Camera& camera = scene.camera;
  const Vec3d eye(camera.origin), forward(camera.forward);
  double nearest = std::numeric_limits<double>::infinity(), farthest = 0;
  for (const Shape& shape : scene.shapes) {
    if (clip.near_clip) nearest = std::min(nearest, clearance(eye, shape));
    if (clip.far_clip) farthest = std::max(farthest, reach(eye, forward, shape));
  }
  const double x = camera.tan_half_x, y = camera.tan_half_y;
  if (clip.near_clip && nearest < *clip.near_clip * std::sqrt(1 + x * x + y * y)) {
    errors.guard([&] {
      fail(clip.near_at,
           "nearClip {} may cut what is {:.4g} from the camera; nothing is cut here: make it less",
           *clip.near_clip, nearest);
    });
  }
  if (clip.far_clip && farthest > *clip.far_clip) {
    errors.guard([&] {
      fail(clip.far_at,
           "farClip {} cuts what is up to {:.4g} deep; nothing is cut here: make it more",
           *clip.far_clip, farthest);
    });
  }
}

}  // namespace carlo
