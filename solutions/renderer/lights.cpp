#include "lights.h"

#include "frame.h"
#include "numeric/robust.h"
#include "spherical_rectangle.h"
#include "warp.h"

#include <algorithm>
#include <cmath>
#include <span>

namespace renderer {
namespace {

using carlo::Disk;
using carlo::Mesh;
using carlo::Parallelogram;
using carlo::Scene;
using carlo::Shape;
using carlo::Sphere;
using Vec3d = glm::dvec3;

struct AreaPoint {
  Vec3 p, n, error;
};

/// A rectangle seen under less than this many steradians is sampled by area: its solid angle is a
/// difference of angles, which keeps only 1e-15 absolute.
constexpr double least_solid_angle = 1e-7;

bool is_rectangle(const Parallelogram& s) {
  return std::abs(glm::dot(s.u, s.v)) <= 1e-5f * glm::length(s.u) * glm::length(s.v);
}

double triangle_area(const Mesh& mesh, glm::uvec3 corner) {
  const Vec3d a(mesh.positions[corner.x]);
  return 0.5 * glm::length(glm::cross(Vec3d(mesh.positions[corner.y]) - a,
                                      Vec3d(mesh.positions[corner.z]) - a));
}

std::vector<double> running_sum(std::vector<double> values) {
  double sum = 0;
  for (double& v : values)
    v = sum += v;
  return values;
}

std::vector<double> mesh_areas(const Mesh& mesh) {
  std::vector<double> areas;
  areas.reserve(mesh.triangles.size());
  for (const glm::uvec3 corner : mesh.triangles)
    areas.push_back(triangle_area(mesh, corner));
  return running_sum(std::move(areas));
}

double area_of(const Shape& shape) {
  struct Visitor {
    double operator()(const Parallelogram& s) const {
      return glm::length(glm::cross(Vec3d(s.u), Vec3d(s.v)));
    }
    double operator()(const Sphere& s) const {
      return 4 * carlo::pi * static_cast<double>(s.radius) * static_cast<double>(s.radius);
    }
    double operator()(const Disk& s) const {
      return carlo::pi * static_cast<double>(s.radius) * static_cast<double>(s.radius);
    }
    double operator()(const Mesh& s) const { return mesh_areas(s).back(); }
    double operator()(const carlo::Sdf&) const { return 0; }  // never emits
  };
  return std::visit(Visitor{}, shape.geometry);
}

/// The element of a running sum that u, in [0, 1), falls into; u becomes its place within.
std::size_t pick(std::span<const double> sums, float& u) {
  const double x = static_cast<double>(u) * sums.back();
  const auto it = std::upper_bound(sums.begin(), sums.end() - 1, x);
  const auto i = static_cast<std::size_t>(it - sums.begin());
  const double lower = i == 0 ? 0 : sums[i - 1];
  u = std::clamp(static_cast<float>((x - lower) / (sums[i] - lower)), 0.0f, 0x1.fffffep-1f);
  return i;
}

AreaPoint sample_area(const Parallelogram& s, Vec2 u) {
  const Vec3d edge_u(s.u), edge_v(s.v);
  const Vec3 p(Vec3d(s.origin) + static_cast<double>(u.x) * edge_u +
               static_cast<double>(u.y) * edge_v);
  return {p, Vec3(glm::normalize(glm::cross(edge_u, edge_v))),
          carlo::rounding_bound(3) * glm::abs(p)};
}

AreaPoint sample_area(const Sphere& s, Vec2 u) {
  const float z = 1 - 2 * u.x;
  const Vec3 n = spherical(z, carlo::safe_sqrt(1 - z * z), u.y);
  return {s.center + s.radius * n, s.flipped ? -n : n,
          carlo::rounding_bound(8) * (glm::abs(s.center) + Vec3(s.radius))};
}

AreaPoint sample_area(const Disk& s, Vec2 u) {
  const Frame frame(s.normal);
  const float r = s.radius * std::sqrt(u.x), phi = 2 * carlo::pi_f * u.y;
  return {s.center + r * (std::cos(phi) * frame.s + std::sin(phi) * frame.t), s.normal,
          carlo::rounding_bound(12) * (glm::abs(s.center) + Vec3(s.radius))};
}

AreaPoint sample_area(const Mesh& mesh, std::span<const double> areas, Vec2 u) {
  const glm::uvec3 corner = mesh.triangles[pick(areas, u.x)];
  const Vec3 a = mesh.positions[corner.x], ab = mesh.positions[corner.y] - a,
             ac = mesh.positions[corner.z] - a;
  const float root = std::sqrt(u.x);
  return {a + root * (1 - u.y) * ab + root * u.y * ac,
          Vec3(glm::normalize(glm::cross(Vec3d(ab), Vec3d(ac)))),
          carlo::rounding_bound(12) * (glm::abs(a) + glm::abs(ab) + glm::abs(ac))};
}

AreaPoint sample_area(const Shape& shape, std::span<const double> mesh_areas, Vec2 u) {
  if (const auto* mesh = std::get_if<Mesh>(&shape.geometry)) {
    return sample_area(*mesh, mesh_areas, u);
  }
  if (const auto* sphere = std::get_if<Sphere>(&shape.geometry)) return sample_area(*sphere, u);
  if (const auto* disk = std::get_if<Disk>(&shape.geometry)) return sample_area(*disk, u);
  return sample_area(std::get<Parallelogram>(shape.geometry), u);
}

/// 1 - cos of the half-angle of the cone in which a sphere is seen; `from` is outside.
float cone_of(const Sphere& s, Vec3 from) {
  const Vec3d d = Vec3d(s.center) - Vec3d(from);
  const double sin2 =
      static_cast<double>(s.radius) * static_cast<double>(s.radius) / glm::dot(d, d);
  return static_cast<float>(sin2 / (1 + std::sqrt(std::max(0.0, 1 - sin2))));
}

/// Whether `from` lies in front of the plane through `point` with normal n, without a doubt.
bool in_front(const Place& from, Vec3d point, Vec3 error, Vec3d n) {
  const double blur = glm::dot(glm::abs(n), Vec3d(from.error) + Vec3d(error));
  return glm::dot(n, Vec3d(from.p) - point) > blur;
}

bool in_front(const Place& from, const RectangleFrame& rectangle) {
  return in_front(from, rectangle.origin, Vec3(0), rectangle.z);
}

/// Whether `from` lies outside of the sphere, without a doubt.
bool outside(const Sphere& s, const Place& from) {
  const Vec3d d = Vec3d(s.center) - Vec3d(from.p);
  const double r = s.radius;
  const Vec3 center_error = carlo::rounding_bound(3) * (glm::abs(s.center) + Vec3(s.radius));
  const double blur = glm::length(Vec3d(from.error) + Vec3d(center_error));
  return glm::length(d) > r + blur;
}

/// The near point of the sphere in a direction of its cone.
AreaPoint sample_sphere_cone(const Sphere& s, Vec3 from, Vec2 u) {
  const Vec3d to_center = Vec3d(s.center) - Vec3d(from);
  const Frame frame(Vec3(glm::normalize(to_center)));
  const Vec3d w(frame.to_world(sample_cone(u, cone_of(s, from))));
  const double r = s.radius, along = glm::dot(to_center, w);
  const Vec3d closest = along * w - to_center;
  const double half_chord = std::sqrt(std::max(0.0, r * r - glm::dot(closest, closest)));
  const Vec3d n = glm::normalize((along - half_chord) * w - to_center);
  const Vec3 p(Vec3d(s.center) + r * n);
  return {p, Vec3(n), carlo::rounding_bound(3) * glm::abs(p)};
}

/// Whether nothing of the shape can lie between its front and what that lights.
bool never_shades_itself(const Shape& shape) {
  const auto* sphere = std::get_if<Sphere>(&shape.geometry);
  return sphere != nullptr ? !sphere->flipped
                           : std::holds_alternative<Parallelogram>(shape.geometry) ||
                                 std::holds_alternative<Disk>(shape.geometry);
}

/// Density per solid angle at `from` of a point of density 1/area.
float area_pdf(Vec3 from, Vec3 p, Vec3 n, double area) {
  const Vec3 d = p - from;
  const float distance2 = glm::dot(d, d);
  const float projected = std::abs(glm::dot(n, d)) / std::sqrt(distance2);
  return static_cast<float>(static_cast<double>(distance2) /
                            (static_cast<double>(projected) * area));
}

}  // namespace

Lights::Lights(const Scene& scene) : scene_(scene) {
  entry_of_shape_.resize(scene.shapes.size());
  mesh_cdf_.resize(scene.shapes.size());
  std::vector<double> power;
  const auto brightness = [](Rgb c) { return static_cast<double>(c.r + c.g + c.b); };
  for (std::uint32_t i = 0; i < scene.shapes.size(); ++i) {
    const Shape& shape = scene.shapes[i];
    if (!shape.emits()) continue;
    const auto* quad = std::get_if<Parallelogram>(&shape.geometry);
    if (const auto* mesh = std::get_if<Mesh>(&shape.geometry)) mesh_cdf_[i] = mesh_areas(*mesh);
    entry_of_shape_[i] = static_cast<std::uint32_t>(entries_.size());
    const double area = area_of(shape);
    std::optional<RectangleFrame> rectangle;
    if (quad != nullptr && is_rectangle(*quad)) rectangle.emplace(*quad);
    entries_.push_back({i, false, rectangle, 0, area});
    power.push_back(carlo::pi * area * brightness(shape.radiance));
  }
  for (std::uint32_t i = 0; i < scene.points.size(); ++i) {
    if (scene.points[i].intensity == Rgb(0)) continue;
    entries_.push_back({i, true, std::nullopt, 0, 0});
    power.push_back(4 * carlo::pi * brightness(scene.points[i].intensity));
  }
  cdf_ = running_sum(power);
  for (std::size_t i = 0; i < entries_.size(); ++i) {
    entries_[i].probability = power[i] / cdf_.back();
  }
}

const Lights::Entry& Lights::choose(float u) const {
  return entries_.size() == 1 ? entries_[0] : entries_[pick(cdf_, u)];
}

std::optional<LightSample> Lights::sample(const Place& from, float u_light, Vec2 u) const {
  const Entry& entry = choose(u_light);
  if (!entry.point) return sample_shape(entry, from, u);
  const carlo::PointLight& light = scene_.points[entry.shape];
  const Vec3 d = light.position - from.p;
  const float distance2 = glm::dot(d, d);
  if (!(distance2 > 0)) return std::nullopt;
  const auto probability = static_cast<float>(entry.probability);
  return LightSample{light.position,
                     Vec3(0),
                     Vec3(0),
                     light.intensity / (distance2 * probability),
                     0,
                     carlo::Intersector::nothing,
                     false};
}

std::optional<LightSample> Lights::sample_shape(const Entry& entry, const Place& from,
                                                Vec2 u) const {
  const Shape& shape = scene_.shapes[entry.shape];
  const auto result = [&](const AreaPoint& point, float density) -> std::optional<LightSample> {
    if (!(density > 0) || !std::isfinite(density)) return std::nullopt;
    const auto probability = static_cast<float>(entry.probability);
    LightSample sample{point.p, point.error, point.n, shape.radiance, probability * density};
    if (never_shades_itself(shape)) sample.shape = entry.shape, sample.shades_itself = false;
    return sample;
  };
  if (entry.rectangle) {
    if (!in_front(from, *entry.rectangle)) return std::nullopt;
    const SphericalRectangle seen(*entry.rectangle, from.p);
    if (seen.solid_angle() >= least_solid_angle) {
      const Vec3 p = seen.sample(u);
      return result({p, Vec3(entry.rectangle->z), carlo::rounding_bound(3) * glm::abs(p)},
                    static_cast<float>(1 / seen.solid_angle()));
    }
  }
  // A sphere that emits outwards does not light its inside. One that emits inwards is sampled by
  // area: from the outside its near half is in the way, and points on it may be rounded either way.
  const auto* sphere = std::get_if<Sphere>(&shape.geometry);
  if (sphere != nullptr && !sphere->flipped) {
    if (!outside(*sphere, from)) return std::nullopt;
    return result(sample_sphere_cone(*sphere, from.p, u), cone_pdf(cone_of(*sphere, from.p)));
  }
  const AreaPoint point = sample_area(shape, mesh_cdf_[entry.shape], u);
  if (!in_front(from, Vec3d(point.p), point.error, Vec3d(point.n))) return std::nullopt;
  return result(point, area_pdf(from.p, point.p, point.n, entry.area));
}

float Lights::pdf(const Place& from, const carlo::Hit& hit) const {
  const Entry& entry = entries_[entry_of_shape_[hit.shape]];
  return static_cast<float>(entry.probability) *
         shape_pdf(entry, from, {hit.p, hit.p_error}, hit.n);
}

float Lights::shape_pdf(const Entry& entry, const Place& from, const Place& point, Vec3 n) const {
  const Shape& shape = scene_.shapes[entry.shape];
  if (entry.rectangle) {
    if (!in_front(from, *entry.rectangle)) return 0;
    const SphericalRectangle seen(*entry.rectangle, from.p);
    if (seen.solid_angle() >= least_solid_angle) {
      return static_cast<float>(1 / seen.solid_angle());
    }
  }
  if (const auto* sphere = std::get_if<Sphere>(&shape.geometry); sphere && !sphere->flipped) {
    return outside(*sphere, from) ? cone_pdf(cone_of(*sphere, from.p)) : 0;
  }
  return in_front(from, Vec3d(point.p), point.error, Vec3d(n))
             ? area_pdf(from.p, point.p, n, entry.area)
             : 0;
}

}  // namespace renderer
