#pragma once

#include "numeric/vec.h"
#include "scene/scene.h"

#include <glm/glm.hpp>

#include <array>
#include <cstdint>
#include <random>
#include <vector>

/// The parts of scenes. Sizes are of the order of 1 until a scene is placed.
namespace proving {

/// Uniform numbers, the same with every standard library.
class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}
  double uniform() { return static_cast<double>(engine_() >> 11) * 0x1p-53; }
  double uniform(double low, double high) { return low + (high - low) * uniform(); }
  /// 10^x for uniform x: all orders of magnitude are equally likely.
  double magnitude(double low, double high);
  glm::dvec3 direction();

 private:
  std::mt19937_64 engine_;
};

/// The placement of a scene: x -> scale (turn x + shift), so that `shift` is in units of the
/// scene's size.
struct Placement {
  glm::dmat3 turn{1};
  double scale = 1;
  glm::dvec3 shift{0};
};

/// A uniformly drawn rotation; number 0 is the identity.
glm::dmat3 rotation(int number);

/// Each coordinate is rounded once. Radiances stay; intensities are scaled by scale^2, so that the
/// effect of point lights stays too.
carlo::Scene placed(carlo::Scene scene, const Placement& placement);

/// An empty scene with a film of size x size pixels and independent samples.
carlo::Scene empty(int size = 8);

carlo::Material diffuse(carlo::Rgb albedo, bool two_sided);
/// A lobe without weight: reflects like diffuse().
carlo::Material lobeless_phong(carlo::Rgb albedo, bool two_sided);

/// The material and emission of a box or a panel.
struct Finish {
  std::uint32_t material = 0;
  carlo::Rgb radiance{0};
};

enum class Facing { outwards, inwards };

/// A rectangle of half sides a and b about a centre; the normal is a x b.
carlo::Shape panel(glm::dvec3 centre, glm::dvec3 a, glm::dvec3 b, Finish finish = {});
/// The square of this half side in the plane y, normal up.
carlo::Shape level(double half, double y, Finish finish = {});
carlo::Shape ball(glm::dvec3 centre, double radius, Finish finish = {},
                  Facing facing = Facing::outwards);

struct Box {
  glm::dvec3 centre{0}, half{1};
  glm::dmat3 turn{1};
  double margin = 0;  ///< by which each face extends beyond its edges
};
/// Six panels.
void add_box(carlo::Scene& scene, const Box& box, Finish finish, Facing facing);

/// A solid of 8 triangles: corners on a sphere of this radius, normals outwards.
carlo::Shape octahedron(glm::dvec3 centre, double radius, Finish finish = {});

carlo::Camera camera_at(glm::dvec3 from, glm::dvec3 at, double fov_degrees);

std::array<double, 3> exact_of(carlo::Rgb value);
std::array<double, 3> exact_of(double value);

}  // namespace proving
