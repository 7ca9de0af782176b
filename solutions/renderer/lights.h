#pragma once

#include "geometry/intersector.h"
#include "numeric/vec.h"
#include "renderer/envmap_table.h"
#include "renderer/light_tree.h"
#include "renderer/spherical_rectangle.h"
#include "scene/scene.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace renderer {

using carlo::Rgb;
using carlo::Vec2;
using carlo::Vec3;

/// A point of a surface with a bound on the rounding error of each of its coordinates.
struct RoundedPoint {
  Vec3 p{0}, error{0};
};

/// A shading point: n is the unit normal of the lit side.
struct ShadingPoint : RoundedPoint {
  Vec3 n{0};
};

/// A point of a light as seen from a surface point.
struct LightSample {
  Vec3 p;        ///< on the light; beyond all shapes for the environment map
  Vec3 p_error;  ///< bound on the rounding error of each coordinate of p
  Vec3 n;        ///< the light's normal there; 0 if it is no surface
  Rgb radiance;  ///< towards the surface point; for a point light intensity / distance^2
  float pdf;     ///< per solid angle at the surface point, light choice included; 0 for a point
                 ///< light, whose radiance is already divided by the probability of its choice
  std::uint32_t shape = carlo::Intersector::nothing;  ///< the light's shape, if that cannot occlude
                                                      ///< itself
  bool shades_itself = true;                          ///< true if it can
};

/// Chooses among a scene's lights by their possible contribution to a point, and samples the chosen
/// one: rectangles and spheres by solid angle, other shapes by area, the environment map by
/// its luminance. Each triangle of a mesh is a light.
class Lights {
 public:
  /// Keeps a reference to `scene`.
  explicit Lights(const carlo::Scene& scene);

  bool empty() const { return leaves_.empty(); }

  /// The least probability with which any light (a mesh as a whole) is chosen; 1 if there is no
  /// choice.
  double least_probability() const {
    return entries_.size() > 1 ? LightTree::floor / static_cast<double>(entries_.size()) : 1;
  }

  /// Returns nothing when the light sends no radiance to `from`, or when rounding hides whether it
  /// does, since a flat light does not light itself. Rays that hit the light account for that
  /// radiance.
  std::optional<LightSample> sample(const ShadingPoint& from, float u_light, Vec2 u) const;

  /// The density, per solid angle at `from`, with which sample() gives the point of `hit`; the hit
  /// shape must emit. 0 where sample() gives nothing.
  float pdf(const ShadingPoint& from, const carlo::Hit& hit) const;

  /// The radiance along direction d from the environment map, and the density with which
  /// sample() gives d at `from`; both 0 if there is no image.
  EnvmapTable::Texel beyond(const ShadingPoint& from, Vec3 d) const;

 private:
  /// A shape, a point or the environment map.
  struct Entry {
    enum class Kind { shape, point, envmap };
    Kind kind;
    std::uint32_t index;  ///< among the scene's shapes or point lights; 0 for the image
    std::optional<RectangleFrame> rectangle = std::nullopt;  ///< for lights sampled by solid angle
    const carlo::Sphere* ball = nullptr;  ///< for spheres sampled by their cone of directions
    const carlo::Mesh* mesh = nullptr;
    bool shades_itself = true;  ///< as in LightSample
    std::uint32_t first_leaf = 0;
  };
  /// A light that can be chosen: an entry, or one triangle of a mesh entry.
  struct Leaf {
    std::uint32_t entry;
    std::uint32_t triangle;
    double area;
  };

  Entry shape_entry(std::uint32_t index) const;
  /// Adds a leaf of an entry, with the bounds that its choice depends on.
  void add_leaf(double area, const LightBounds& bounds, std::vector<LightBounds>& all,
                std::uint32_t triangle = 0);
  void add_shape(std::uint32_t index, std::vector<LightBounds>& all);
  std::optional<LightSample> sample_point(const Entry& entry, const RoundedPoint& from) const;
  LightSample sample_envmap(const RoundedPoint& from, Vec2 u) const;
  std::optional<LightSample> sample_shape(const Leaf& leaf, const RoundedPoint& from, Vec2 u) const;
  /// The density at `from` of a point with normal n on a leaf that is a shape or part of one.
  float shape_pdf(const Leaf& leaf, const RoundedPoint& from, const RoundedPoint& point,
                  Vec3 n) const;

  const carlo::Scene& scene_;
  std::vector<Entry> entries_;
  std::vector<Leaf> leaves_;
  std::optional<LightTree> tree_;  ///< over the leaves
  std::vector<std::uint32_t> entry_of_shape_;
  std::optional<EnvmapTable> envmap_;
  bool envmap_is_sampled_ = false;  ///< the image is the last leaf
  float far_ = 0;                   ///< a distance beyond all shapes, from any point
};

}  // namespace renderer
