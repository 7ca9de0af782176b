#pragma once

#include "geometry/intersector.h"
#include "given/light_choice.h"
#include "numeric/vec.h"
#include "scene/scene.h"

#include <cstdint>
#include <optional>
#include <span>
#include <variant>
#include <vector>

namespace lab08 {

using carlo::Ray;
using carlo::Rgb;
using carlo::Vec2;
using carlo::Vec3;

/// The reflection of a surface: Phong (a diffuse one has ks = 0, a black one kd = 0 too), a perfect
/// mirror, or glass.
using Material = std::variant<carlo::Phong, carlo::Mirror, carlo::Dielectric>;

/// The point where a ray met a surface, as seen by the ray.
struct Surface {
  Vec3 p;                    ///< the point
  Vec3 n;                    ///< unit normal on wo's side; of a mesh, its triangle's
  Vec3 wo;                   ///< unit vector towards the ray's origin
  Rgb Le{0};                 ///< radiance emitted towards wo
  const Material* material;  ///< black for the back of a one-sided surface
  bool front = true;         ///< true if n is the shape's own normal; with glass: seen from outside
  carlo::Hit hit;            ///< for World's functions

  /// The material of a Phong surface; throws carlo::Error for mirrors and glass.
  const carlo::Phong& phong() const;
};

/// A point of a light.
struct LightPoint {
  Vec3 p;
  Vec3 n;        ///< unit normal on the side that emits
  Rgb radiance;  ///< emitted on that side: the same in all directions and at all points of a light
  Vec3 p_error;  ///< bound on the rounding error of each coordinate of p
};

/// An emitting shape, or one triangle of an emitting mesh.
class Light {
 public:
  explicit Light(const carlo::Shape& shape, std::uint32_t triangle = 0);
  /// A point on it, uniform by area: its density is 1 / area().
  LightPoint sample(Vec2 u) const;
  float area() const { return area_; }
  /// The probability with which World::choose() chooses this light.
  float chance() const { return chance_; }

 private:
  friend class World;
  const carlo::Shape* shape_;
  std::uint32_t triangle_;
  float area_ = 0, chance_ = 0;
};

/// The scene in which rays are traced.
class World {
 public:
  /// Throws carlo::Error for what lab 8 does not support: point lights and images as lights.
  explicit World(carlo::Scene scene);
  World(const World&) = delete;
  World& operator=(const World&) = delete;

  /// The nearest surface along a ray.
  std::optional<Surface> intersect(const Ray& ray) const;
  /// The radiance along a ray that meets no surface.
  Rgb environment() const { return scene_.lights.environment; }
  /// The ray that leaves a surface point in direction wi, to either side of it. It starts off the
  /// surface by as much as rounding demands, so that it does not meet the surface again.
  Ray leave(const Surface& surface, Vec3 wi) const;
  /// True if nothing blocks the segment between a surface point and a point of a light.
  bool sees(const Surface& surface, const LightPoint& light) const;

  /// The emitting surfaces; may be empty.
  std::span<const Light> lights() const { return lights_; }
  /// Chooses one of the lights, if there are any, by a number u of [0, 1): with probability 1/2 by
  /// power (its luminance), otherwise with equal probability for each of the n emitting shapes, and
  /// for each triangle of a mesh. So no light has a probability below 1/2n, or 1/2nm as one of m
  /// triangles. Divide by its chance().
  const Light& choose(double u) const { return lights_[choice_(u)]; }
  /// The light that a surface belongs to, or null.
  const Light* light_of(const Surface& surface) const;

  const carlo::Scene& scene() const { return scene_; }

 private:
  void find_lights();

  carlo::Scene scene_;
  carlo::Intersector intersector_;
  std::vector<Material> materials_;
  std::vector<Light> lights_;
  LightChoice choice_;
  std::vector<std::int64_t> light_of_shape_;  ///< its only light, or the first; -1: none
};

}  // namespace lab08
