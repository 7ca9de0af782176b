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
struct Place {
  Vec3 p{0}, error{0};
};

/// One that light falls on: n is the unit normal of the side that is lit.
struct Receiver : Place {
  Vec3 n{0};
};

/// A point of a light as seen from a surface point.
struct LightSample {
  Vec3 p;        ///< on the light; of the image around the scene beyond all shapes
  Vec3 p_error;  ///< bound on the rounding error of each coordinate of p
  Vec3 n;        ///< the light's normal there; 0 for what is no surface
  Rgb radiance;  ///< towards the surface point; for a point light intensity / distance^2
  float pdf;     ///< per solid angle at the surface point, light choice included; 0 for a point
                 ///< light, whose radiance is already divided by the probability of its choice
  std::uint32_t shape = carlo::Intersector::nothing;  ///< if it cannot be in its own way
  bool shades_itself = true;                          ///< otherwise
};

/// Chooses among a scene's lights by what they can bring to a point, and samples the chosen one:
/// rectangles and spheres by solid angle, other shapes by area, the image around the scene by its
/// luminance. Of a mesh each triangle is a light.
class Lights {
 public:
  /// Keeps a reference to `scene`.
  explicit Lights(const carlo::Scene& scene);

  bool empty() const { return leaves_.empty(); }

  /// With which any of them, a mesh as a whole, is asked; 1 where there is no choice.
  double least_chance() const {
    return entries_.size() > 1 ? LightTree::floor / static_cast<double>(entries_.size()) : 1;
  }

  /// Nothing when the light sends no radiance to `from`, or when rounding hides whether it does: a
  /// flat light does not light itself. What comes from there is left to rays that meet the light.
  std::optional<LightSample> sample(const Receiver& from, float u_light, Vec2 u) const;

  /// The density, per solid angle at `from`, with which sample() gives the point of `hit`; the hit
  /// shape must emit. 0 where sample() gives nothing.
  float pdf(const Receiver& from, const carlo::Hit& hit) const;

  /// What rays in direction d bring from the image around the scene, and the density with which
  /// sample() gives d at `from`; 0 of both if there is none.
  EnvmapTable::Texel beyond(const Receiver& from, Vec3 d) const;

 private:
  /// A shape, a point or the image around the scene.
  struct Entry {
    enum class Kind { shape, point, envmap };
    Kind kind;
    std::uint32_t index;  ///< among the scene's shapes or point lights; of the image 0
    std::optional<RectangleFrame> rectangle = std::nullopt;  ///< of lights sampled by solid angle,
    const carlo::Sphere* ball = nullptr;  ///< and of those sampled by their cone of directions
    const carlo::Mesh* mesh = nullptr;
    bool shades_itself = true;  ///< as LightSample's
    std::uint32_t first_leaf = 0;
  };
  /// What is chosen: an entry, of a mesh one of its triangles.
  struct Leaf {
    std::uint32_t entry;
    std::uint32_t triangle;
    double area;
  };

  Entry shape_entry(std::uint32_t index) const;
  /// An entry's leaf, and what its choice goes by.
  void add_leaf(double area, const LightBounds& bounds, std::vector<LightBounds>& all,
                std::uint32_t triangle = 0);
  void add_shape(std::uint32_t index, std::vector<LightBounds>& all);
  std::optional<LightSample> sample_point(const Entry& entry, const Place& from) const;
  LightSample sample_envmap(const Place& from, Vec2 u) const;
  std::optional<LightSample> sample_shape(const Leaf& leaf, const Place& from, Vec2 u) const;
  /// Density at `from` of a point with normal n of a leaf that is (of) a shape.
  float shape_pdf(const Leaf& leaf, const Place& from, const Place& point, Vec3 n) const;

  const carlo::Scene& scene_;
  std::vector<Entry> entries_;
  std::vector<Leaf> leaves_;
  std::optional<LightTree> tree_;  ///< of the leaves
  std::vector<std::uint32_t> entry_of_shape_;
  std::optional<EnvmapTable> envmap_;
  bool envmap_is_sampled_ = false;  ///< as the last leaf
  float far_ = 0;                   ///< beyond all shapes, from wherever
};

}  // namespace renderer
