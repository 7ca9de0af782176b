#include "lights.h"

#include "mesh_light.h"
#include "numeric/robust.h"
#include "scene/center.h"
#include "scene/match.h"
#include "spherical_rectangle.h"
#include "support/error.h"
#include "warp.h"

#include <algorithm>
#include <cmath>

namespace renderer {
namespace {

using carlo::Disk;
using carlo::Mesh;
using carlo::Parallelogram;
using carlo::Scene;
using carlo::Sdf;
using carlo::Shape;
using carlo::Sphere;
using Vec3d = glm::dvec3;

struct AreaPoint {
  Vec3 p, n, error;
};

/// Rectangles that subtend less than this many steradians are sampled by area: their solid angle is
/// a difference of angles, accurate only to 1e-15 absolute.
constexpr double least_solid_angle = 1e-7;

bool is_rectangle(const Parallelogram& s) {
  return std::abs(glm::dot(s.u, s.v)) <= 1e-5f * glm::length(s.u) * glm::length(s.v);
}

double area_of(const Parallelogram& s) {
  return glm::length(glm::cross(Vec3d(s.u), Vec3d(s.v)));
}
double area_of(const Sphere& s) {
  return 4 * carlo::pi * static_cast<double>(s.radius) * static_cast<double>(s.radius);
}
double area_of(const Disk& s) {
  return carlo::pi * static_cast<double>(s.radius) * static_cast<double>(s.radius);
}

[[noreturn]] void refuse(const Sdf&) {
  throw carlo::Error("an sdf cannot emit");
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
  const Vec2 place = s.radius * std::sqrt(u.x) * on_circle(u.y);
  return {s.center + place.x * frame.s + place.y * frame.t, s.normal,
          carlo::rounding_bound(12) * (glm::abs(s.center) + Vec3(s.radius))};
}

AreaPoint sample_area(const Shape& shape, std::uint32_t triangle, Vec2 u) {
  return carlo::match(
      shape.geometry, [&](const Parallelogram& s) { return sample_area(s, u); },
      [&](const Sphere& s) { return sample_area(s, u); },
      [&](const Disk& s) { return sample_area(s, u); },
      [&](const Mesh& s) -> AreaPoint {
        const carlo::TrianglePoint point = sample_triangle(s, triangle, u);
        return {point.p, point.n, point.error};
      },
      [](const Sdf& s) -> AreaPoint { refuse(s); });
}

/// 1 - cos of the half-angle of the cone that a sphere subtends; `from` is outside the sphere.
float cone_of(const Sphere& s, Vec3 from) {
  const Vec3d d = Vec3d(s.center) - Vec3d(from);
  const double sin2 =
      static_cast<double>(s.radius) * static_cast<double>(s.radius) / glm::dot(d, d);
  return static_cast<float>(sin2 / (1 + std::sqrt(std::max(0.0, 1 - sin2))));
}

/// True if `from` lies in front of the plane through `point` with normal n, despite rounding.
bool in_front(const RoundedPoint& from, Vec3d point, Vec3 error, Vec3d n) {
  const double blur = glm::dot(glm::abs(n), Vec3d(from.error) + Vec3d(error));
  return glm::dot(n, Vec3d(from.p) - point) > blur;
}

bool in_front(const RoundedPoint& from, const RectangleFrame& rectangle) {
  return in_front(from, rectangle.origin, Vec3(0), rectangle.z);
}

/// True if `from` lies outside the sphere, despite rounding.
bool outside(const Sphere& s, const RoundedPoint& from) {
  const Vec3d d = Vec3d(s.center) - Vec3d(from.p);
  const double r = s.radius;
  const Vec3 center_error = carlo::rounding_bound(3) * (glm::abs(s.center) + Vec3(s.radius));
  const double blur = glm::length(Vec3d(from.error) + Vec3d(center_error));
  return glm::length(d) > r + blur;
}

/// The nearer point of the sphere in a direction of its cone.
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

/// Converts the density 1/area of a point to one per solid angle at `from`.
float area_pdf(Vec3 from, Vec3 p, Vec3 n, double area) {
  const Vec3 d = p - from;
  const float distance2 = glm::dot(d, d);
  const float projected = std::abs(glm::dot(n, d)) / std::sqrt(distance2);
  return static_cast<float>(static_cast<double>(distance2) /
                            (static_cast<double>(projected) * area));
}

double sum_of_channels(Rgb c) {
  return static_cast<double>(c.r) + static_cast<double>(c.g) + static_cast<double>(c.b);
}

LightBounds bounds_of(const Parallelogram& s, double radiance) {
  const Vec3d o(s.origin), u(s.u), v(s.v), across = o + u + v;
  return {glm::min(glm::min(o, o + u), glm::min(o + v, across)),
          glm::max(glm::max(o, o + u), glm::max(o + v, across)), glm::normalize(glm::cross(u, v)),
          1, radiance * area_of(s)};
}
LightBounds bounds_of(const Disk& s, double radiance) {
  const Vec3d n(s.normal);
  const Vec3d half = static_cast<double>(s.radius) * glm::sqrt(glm::max(Vec3d(0), 1.0 - n * n));
  return {Vec3d(s.center) - half, Vec3d(s.center) + half, n, 1, radiance * area_of(s)};
}
/// From every direction as bright as a disk of its radius.
LightBounds bounds_of(const Sphere& s, double radiance) {
  const Vec3d half(static_cast<double>(s.radius));
  return {Vec3d(s.center) - half, Vec3d(s.center) + half, {}, -1, radiance * area_of(s) / 4};
}
LightBounds bounds_of(const carlo::PointLight& light) {
  return {Vec3d(light.position), Vec3d(light.position), {}, -1, sum_of_channels(light.intensity)};
}

}  // namespace

Lights::Lights(const Scene& scene) : scene_(scene) {
  entry_of_shape_.resize(scene.shapes.size());
  std::vector<LightBounds> bounds;
  for (std::uint32_t i = 0; i < scene.shapes.size(); ++i) {
    if (scene.shapes[i].emits()) add_shape(i, bounds);
  }
  const auto& [points, environment, envmap] = scene.lights;
  (void)environment;  // is left to rays that meet no shape
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    if (points[i].intensity == Rgb(0)) continue;
    entries_.push_back({Entry::Kind::point, i});
    add_leaf(0, bounds_of(points[i]), bounds);
  }
  if (envmap) envmap_.emplace(*envmap);
  envmap_is_sampled_ = envmap && !scene.shapes.empty();
  std::optional<double> around;
  if (envmap_is_sampled_) {
    far_ = static_cast<float>(std::min(2 * carlo::diameter(scene), 1e18));  // its square fits into
                                                                            // a float
    entries_.push_back({Entry::Kind::envmap, 0});
    leaves_.push_back({static_cast<std::uint32_t>(entries_.size() - 1), 0, 0});
    // The mean over all orientations of the surface.
    around = envmap_->brightness / 4;
  }
  if (!leaves_.empty()) tree_.emplace(bounds, around);
}

void Lights::add_leaf(double area, const LightBounds& bounds, std::vector<LightBounds>& all,
                      std::uint32_t triangle) {
  leaves_.push_back({static_cast<std::uint32_t>(entries_.size() - 1), triangle, area});
  all.push_back(bounds);
}

void Lights::add_shape(std::uint32_t index, std::vector<LightBounds>& all) {
  const Shape& shape = scene_.shapes[index];
  entry_of_shape_[index] = static_cast<std::uint32_t>(entries_.size());
  entries_.push_back(shape_entry(index));
  entries_.back().first_leaf = static_cast<std::uint32_t>(leaves_.size());
  const double radiance = sum_of_channels(shape.radiance);
  const auto add = [&](const auto& s) { add_leaf(area_of(s), bounds_of(s, radiance), all); };
  carlo::match(
      shape.geometry, [&](const Parallelogram& s) { add(s); }, [&](const Sphere& s) { add(s); },
      [&](const Disk& s) { add(s); },
      [&](const Mesh& s) {
        double whole = 0;
        for (std::uint32_t i = 0; i < s.triangles.size(); ++i)
          whole += triangle_area(s, i);
        for (std::uint32_t i = 0; i < s.triangles.size(); ++i) {
          LightBounds bounds = triangle_bounds(s, i, radiance);
          // The triangles of a light source share the floor probability of one light.
          bounds.floor_share = triangle_area(s, i) / whole;
          add_leaf(triangle_area(s, i), bounds, all, i);
        }
      },
      [](const Sdf& s) { refuse(s); });
}

Lights::Entry Lights::shape_entry(std::uint32_t index) const {
  Entry entry{Entry::Kind::shape, index};
  carlo::match(
      scene_.shapes[index].geometry,
      [&](const Parallelogram& s) {
        entry.shades_itself = false;
        if (is_rectangle(s)) entry.rectangle.emplace(s);
      },
      [&](const Sphere& s) {
        entry.shades_itself = s.flipped;
        // A sphere that emits outwards does not light its inside. One that emits inwards is sampled
        // by area: seen from outside, its near half is in the way, and points on it may be rounded
        // to either side.
        if (!s.flipped) entry.ball = &s;
      },
      [&](const Disk&) { entry.shades_itself = false; }, [&](const Mesh& s) { entry.mesh = &s; },
      [](const Sdf& s) { refuse(s); });
  return entry;
}

std::optional<LightSample> Lights::sample(const ShadingPoint& from, float u_light, Vec2 u) const {
  const auto choice = tree_->sample(from.p, from.n, with_more_digits(u_light, u));
  if (!choice) return std::nullopt;
  const Leaf& leaf = leaves_[choice->light];
  const auto probability = static_cast<float>(choice->probability);
  std::optional<LightSample> sample;
  switch (entries_[leaf.entry].kind) {
    case Entry::Kind::shape:
      sample = sample_shape(leaf, from, u);
      break;
    case Entry::Kind::point:
      sample = sample_point(entries_[leaf.entry], from);
      if (sample) sample->radiance /= probability;
      break;
    case Entry::Kind::envmap:
      sample = sample_envmap(from, u);
      break;
  }
  if (sample) sample->pdf *= probability;
  return sample;
}

std::optional<LightSample> Lights::sample_point(const Entry& entry,
                                                const RoundedPoint& from) const {
  const carlo::PointLight& light = scene_.lights.points[entry.index];
  const Vec3 d = light.position - from.p;
  const float distance2 = glm::dot(d, d);
  if (!(distance2 > 0)) return std::nullopt;
  return LightSample{
      light.position, Vec3(0), Vec3(0), light.intensity / distance2, 0, carlo::Intersector::nothing,
      false};
}

LightSample Lights::sample_envmap(const RoundedPoint& from, Vec2 u) const {
  const EnvmapTable::Sample sample = envmap_->sample(u);
  return {from.p + far_ * sample.wi,   Vec3(0), Vec3(0), sample.radiance, sample.pdf,
          carlo::Intersector::nothing, false};
}

EnvmapTable::Texel Lights::beyond(const ShadingPoint& from, Vec3 d) const {
  if (!envmap_) return {Rgb(0), 0};
  EnvmapTable::Texel texel = envmap_->at(d);
  if (!envmap_is_sampled_) return {texel.radiance, 0};
  const auto last = static_cast<std::uint32_t>(leaves_.size() - 1);
  texel.pdf *= static_cast<float>(tree_->probability(last, from.p, from.n));
  return texel;
}

std::optional<LightSample> Lights::sample_shape(const Leaf& leaf, const RoundedPoint& from,
                                                Vec2 u) const {
  const Entry& entry = entries_[leaf.entry];
  const Shape& shape = scene_.shapes[entry.index];
  const auto result = [&](const AreaPoint& point, float density) -> std::optional<LightSample> {
    if (!(density > 0) || !std::isfinite(density)) return std::nullopt;
    LightSample sample{point.p, point.error, point.n, shape.radiance, density};
    if (!entry.shades_itself) sample.shape = entry.index, sample.shades_itself = false;
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
  if (entry.ball != nullptr) {
    if (!outside(*entry.ball, from)) return std::nullopt;
    return result(sample_sphere_cone(*entry.ball, from.p, u),
                  cone_pdf(cone_of(*entry.ball, from.p)));
  }
  const AreaPoint point = sample_area(shape, leaf.triangle, u);
  if (!in_front(from, Vec3d(point.p), point.error, Vec3d(point.n))) return std::nullopt;
  return result(point, area_pdf(from.p, point.p, point.n, leaf.area));
}

float Lights::pdf(const ShadingPoint& from, const carlo::Hit& hit) const {
  const Entry& entry = entries_[entry_of_shape_[hit.shape]];
  const std::uint32_t leaf = entry.first_leaf + (entry.mesh != nullptr ? hit.primitive : 0);
  const float density = shape_pdf(leaves_[leaf], from, {hit.p, hit.p_error}, hit.n);
  if (!(density > 0)) return 0;
  return density * static_cast<float>(tree_->probability(leaf, from.p, from.n));
}

float Lights::shape_pdf(const Leaf& leaf, const RoundedPoint& from, const RoundedPoint& point,
                        Vec3 n) const {
  const Entry& entry = entries_[leaf.entry];
  if (entry.rectangle) {
    if (!in_front(from, *entry.rectangle)) return 0;
    const SphericalRectangle seen(*entry.rectangle, from.p);
    if (seen.solid_angle() >= least_solid_angle) {
      return static_cast<float>(1 / seen.solid_angle());
    }
  }
  if (entry.ball != nullptr) {
    return outside(*entry.ball, from) ? cone_pdf(cone_of(*entry.ball, from.p)) : 0;
  }
  return in_front(from, Vec3d(point.p), point.error, Vec3d(n))
             ? area_pdf(from.p, point.p, n, leaf.area)
             : 0;
}

}  // namespace renderer
